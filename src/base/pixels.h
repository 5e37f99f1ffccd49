// A picture as files hold it.
#pragma once

#include <cstdint>
#include <vector>

namespace scumble {

struct Pixels {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba;  // 4 bytes a pixel, row 0 at the top; sRGB-encoded colour, straight alpha
};

}  // namespace scumble
