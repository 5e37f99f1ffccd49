// The JPEG half of image_decode.h: apart, because libjpeg's errors jump.
#pragma once

#include <string>

#include "base/file_bytes.h"
#include "base/pixels.h"

namespace scumble {

bool readJpegSize(Bytes bytes, uint32_t& width, uint32_t& height, std::string& problem);

// `image` has its size and room for its pixels.
bool decodeJpeg(Bytes bytes, Pixels& image, std::string& problem);

}  // namespace scumble
