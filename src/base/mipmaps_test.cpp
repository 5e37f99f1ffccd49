// Mip levels against means in double precision, each level from the one above it as it was made.
#include "base/mipmaps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace scumble {
namespace {

double linearOfByte(uint8_t byte) {
  const double code = byte / 255.0;
  return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}
double byteOfLinear(double linear) {
  return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

std::vector<uint8_t> noise(uint32_t width, uint32_t height, uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<uint8_t> rgba(size_t(width) * height * 4);
  for (size_t i = 0; i < rgba.size(); ++i) rgba[i] = uint8_t(random() & 0xFF);
  // Whole, half and not there, so that weights matter.
  for (size_t i = 3; i < rgba.size(); i += 4) rgba[i] = std::array<uint8_t, 3>{255, 128, 0}[random() % 3];
  return rgba;
}

constexpr uint32_t kSizes[][2] = {{8, 4}, {5, 3}, {1, 7}, {16, 1}, {9, 9}};

// Calls check(the four bytes above, got) for each byte of each level; gives the number of levels.
template <class Check>
size_t forEachByte(const std::vector<uint8_t>& rgba, uint32_t width, uint32_t height,
                   const std::vector<std::vector<uint8_t>>& levels, const Check& check) {
  const std::vector<uint8_t>* above = &rgba;
  for (const std::vector<uint8_t>& level : levels) {
    const uint32_t w = std::max(1u, width / 2), h = std::max(1u, height / 2);
    EXPECT_EQ(level.size(), size_t(w) * h * 4);
    if (level.size() != size_t(w) * h * 4) return 0;
    for (uint32_t y = 0; y < h; ++y)
      for (uint32_t x = 0; x < w; ++x) {
        const uint8_t* from[4];
        for (uint32_t i = 0; i < 4; ++i)
          from[i] = above->data() + 4 * (size_t(std::min(2 * y + i / 2, height - 1)) * width +
                                         std::min(2 * x + i % 2, width - 1));
        check(from, &level[4 * (size_t(y) * w + x)]);
      }
    above = &level, width = w, height = h;
  }
  EXPECT_EQ(width * height, 1u);
  return levels.size();
}

TEST(Mipmaps, colorsAreMeansOfLightByAlpha) {
  size_t texels = 0;
  for (const auto& [width, height] : kSizes) {
    const std::vector<uint8_t> rgba = noise(width, height, width);
    forEachByte(rgba, width, height, makeMipmaps(rgba, width, height),
                [&](const uint8_t* const from[4], const uint8_t* got) {
                  ++texels;
                  double alpha = 0, sum[3] = {}, plain[3] = {};
                  for (int i = 0; i < 4; ++i) {
                    alpha += from[i][3];
                    for (int c = 0; c < 3; ++c) {
                      sum[c] += from[i][3] * linearOfByte(from[i][c]);
                      plain[c] += 0.25 * linearOfByte(from[i][c]);
                    }
                  }
                  // Colours go through steps of 1 / 4095 and bytes, 0.4 and 0.5 of a byte where it is
                  // darkest; what is transparent has a thousandth of weight.
                  for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(got[c], byteOfLinear(alpha > 0 ? sum[c] / alpha : plain[c]), 1.1);
                  EXPECT_NEAR(got[3], alpha / 4, 0.61);
                });
  }
  EXPECT_GT(texels, 40u);
}

TEST(Mipmaps, valuesArePlainMeans) {
  size_t texels = 0;
  for (const auto& [width, height] : kSizes) {
    const std::vector<uint8_t> rgba = noise(width, height, 50 + width);
    forEachByte(rgba, width, height, makeValueMipmaps(rgba, width, height),
                [&](const uint8_t* const from[4], const uint8_t* got) {
                  ++texels;
                  for (int c = 0; c < 4; ++c)
                    EXPECT_NEAR(got[c], (from[0][c] + from[1][c] + from[2][c] + from[3][c]) / 4.0, 0.5);
                });
  }
  EXPECT_GT(texels, 40u);
}

TEST(Mipmaps, aSinglePixelHasNoLevels) {
  const std::vector<uint8_t> rgba{1, 2, 3, 4};
  EXPECT_TRUE(makeMipmaps(rgba, 1, 1).empty());
  EXPECT_TRUE(makeValueMipmaps(rgba, 1, 1).empty());
}

}  // namespace
}  // namespace scumble
