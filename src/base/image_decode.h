// PNG, JPEG and WebP from memory to RGBA8.
#pragma once

#include <cstdint>
#include <string>

#include "base/file_bytes.h"
#include "base/pixels.h"

namespace scumble {

// Width and height as the header claims them; false when the bytes are no picture that we can read, and
// `problem` says why. Cheap, and the place where absurd claims are refused before anything is allocated.
bool readImageSize(Bytes bytes, uint32_t& width, uint32_t& height, std::string& problem);

// Fills width, height and pixels. False when that is not possible. A picture that is damaged but can be shown
// succeeds with a `problem`.
bool decodeImage(Bytes bytes, Pixels& image, std::string& problem);

}  // namespace scumble
