// What a pass has put out as a picture that one can look at: arithmetic alone.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scumble/image.h"

namespace scumble::viewer {

// Bytes of RGBA in sRGB's curve, row 0 at the top, opaque. Colours are put over black; `aov` decides about
// the others: directions from -1 to 1 become 0 to 1, whole numbers a colour each, motion a hue by its
// direction, and everything else is stretched from its least finite number to its greatest, near depths
// lighter; what is one number everywhere is that, from 0 to 1.
std::vector<uint8_t> visibleBytes(const Image& image, const std::string& aov);

// The numbers of one pixel with the names of their channels, as one line.
std::string pixelText(const Image& image, uint32_t x, uint32_t y);

}  // namespace scumble::viewer
