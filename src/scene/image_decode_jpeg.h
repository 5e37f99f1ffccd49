// The JPEG half of image_decode.h: apart, because libjpeg's errors jump.
#pragma once

#include <string>

#include "scene/file_bytes.h"
#include "scene/scene_data.h"

namespace scumble::scene {

bool readJpegSize(Bytes bytes, uint32_t& width, uint32_t& height, std::string& problem);

// `image` has its size and room for its pixels.
bool decodeJpeg(Bytes bytes, Image& image, std::string& problem);

}  // namespace scumble::scene
