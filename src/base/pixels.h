// A picture as files hold it.
#pragma once

#include <cstdint>
#include <vector>

namespace scumble {

// Most pixels a side of any picture, texture or frame.
constexpr uint32_t kMaxImageSide = 16384;

struct Pixels {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba;  // 4 bytes a pixel, row 0 at the top; sRGB-encoded colour, straight alpha
};

// FNV-1a of size and bytes: the same for the same picture, wherever it was read from.
inline uint64_t contentsOf(const Pixels& pixels) {
  uint64_t hash = 14695981039346656037ull ^ (uint64_t(pixels.width) << 32 | pixels.height);
  for (const uint8_t byte : pixels.rgba) hash = (hash ^ byte) * 1099511628211ull;
  return hash;
}

}  // namespace scumble
