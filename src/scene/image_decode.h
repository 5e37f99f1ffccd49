// PNG, JPEG and WebP from memory to RGBA8.
#pragma once

#include <cstdint>
#include <string>

#include "scene/file_bytes.h"
#include "scene/scene_data.h"

namespace scumble::scene {

constexpr uint32_t kMaxImageSide = 16384;

// Width and height as the header claims them; false when the bytes are no picture that we can read, and
// `problem` says why. Cheap, and the place where absurd claims are refused before anything is allocated.
bool readImageSize(Bytes bytes, uint32_t& width, uint32_t& height, std::string& problem);

// Fills width, height and pixels. False when that is not possible. A picture that is damaged but can be shown
// succeeds with a `problem`.
bool decodeImage(Bytes bytes, Image& image, std::string& problem);

// The visible pattern for what cannot be used: a checker of magenta and grey.
void makeStandIn(Image& image);

}  // namespace scumble::scene
