#include "base/mipmaps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/srgb.h"

namespace scumble {

namespace {

// sRGB bytes by linear value in steps of 1 / 4095: within one byte of exact, which is enough for a filtered
// level.
const std::array<uint8_t, 4096>& toSrgb() {
  static const std::array<uint8_t, 4096> table = [] {
    std::array<uint8_t, 4096> t{};
    for (uint32_t i = 0; i < t.size(); ++i) t[i] = uint8_t(std::lround(255 * srgbFromLinear(i / 4095.0)));
    return t;
  }();
  return table;
}

// `mean` makes a pixel of the 2 x 2 above it.
template <class Mean>
std::vector<std::vector<uint8_t>> halve(std::span<const uint8_t> rgba, uint32_t width, uint32_t height,
                                        const Mean& mean) {
  std::vector<std::vector<uint8_t>> levels;
  const uint8_t* above = rgba.data();
  while (width > 1 || height > 1) {
    const uint32_t w = std::max(1u, width / 2), h = std::max(1u, height / 2);
    std::vector<uint8_t> level(size_t(w) * h * 4);
    for (uint32_t y = 0; y < h; ++y) {
      const uint32_t y0 = std::min(2 * y, height - 1), y1 = std::min(2 * y + 1, height - 1);
      for (uint32_t x = 0; x < w; ++x) {
        const uint32_t x0 = std::min(2 * x, width - 1), x1 = std::min(2 * x + 1, width - 1);
        const uint8_t* texels[4] = {
            above + 4 * (size_t(y0) * width + x0), above + 4 * (size_t(y0) * width + x1),
            above + 4 * (size_t(y1) * width + x0), above + 4 * (size_t(y1) * width + x1)};
        mean(texels, &level[4 * (size_t(y) * w + x)]);
      }
    }
    levels.push_back(std::move(level));
    above = levels.back().data();
    width = w, height = h;
  }
  return levels;
}

}  // namespace

std::vector<std::vector<uint8_t>> makeMipmaps(std::span<const uint8_t> rgba, uint32_t width,
                                              uint32_t height) {
  const auto& linear = linearFromSrgb8();
  const auto& srgb = toSrgb();
  return halve(rgba, width, height, [&](const uint8_t* const texels[4], uint8_t* out) {
    float sum[3] = {}, alpha = 0;
    for (int i = 0; i < 4; ++i) {
      const uint8_t* t = texels[i];
      // A little weight for what is transparent, so that a level without alpha keeps its colour.
      const float weight = float(t[3]) + 1e-3f;
      for (int c = 0; c < 3; ++c) sum[c] += weight * linear[t[c]];
      alpha += weight;
    }
    for (int c = 0; c < 3; ++c) out[c] = srgb[size_t(std::lround(sum[c] / alpha * 4095.0f))];
    out[3] = uint8_t(alpha / 4.0f + 0.4f);
  });
}

std::vector<std::vector<uint8_t>> makeValueMipmaps(std::span<const uint8_t> rgba, uint32_t width,
                                                   uint32_t height) {
  return halve(rgba, width, height, [](const uint8_t* const t[4], uint8_t* out) {
    for (int c = 0; c < 4; ++c) out[c] = uint8_t((t[0][c] + t[1][c] + t[2][c] + t[3][c] + 2) / 4);
  });
}

}  // namespace scumble
