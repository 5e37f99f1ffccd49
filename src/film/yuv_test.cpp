#include "film/yuv.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/srgb.h"

namespace scumble::film {
namespace {

// BT.709 in double precision, limited range.
struct Reference {
  double y, cb, cr;
};
Reference reference(double r, double g, double b) {
  const double y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
  return {16 + 219 * y / 255, 128 + 224 * (b - y) / 1.8556 / 255, 128 + 224 * (r - y) / 1.5748 / 255};
}

Image evenly(uint32_t width, uint32_t height, const std::vector<float>& pixel) {
  Image image{width, height, std::vector<std::string>(pixel.size(), "x"), {}};
  for (uint32_t i = 0; i < width * height; ++i)
    image.pixels.insert(image.pixels.end(), pixel.begin(), pixel.end());
  return image;
}

TEST(Yuv, everyColourIsRoundedFromBt709) {
  const auto& linear = linearFromSrgb8();
  for (int r = 0; r < 256; r += 15)
    for (int g = 0; g < 256; g += 15)
      for (int b = 0; b < 256; b += 15) {
        const std::vector<uint8_t> planes =
            yuv420(evenly(2, 2, {linear[size_t(r)], linear[size_t(g)], linear[size_t(b)]}));
        ASSERT_EQ(planes.size(), 6u);
        const Reference exact = reference(r, g, b);
        ASSERT_NEAR(planes[0], exact.y, 0.501);
        ASSERT_NEAR(planes[4], exact.cb, 0.501);
        ASSERT_NEAR(planes[5], exact.cr, 0.501);
      }
}

TEST(Yuv, greysHaveNoColour) {
  for (const float grey : linearFromSrgb8()) {
    const std::vector<uint8_t> planes = yuv420(evenly(2, 2, {grey}));
    ASSERT_EQ(planes[4], 128);
    ASSERT_EQ(planes[5], 128);
  }
  EXPECT_EQ(yuv420(evenly(2, 2, {0}))[0], 16);
  EXPECT_EQ(yuv420(evenly(2, 2, {1}))[0], 235);
}

TEST(Yuv, oddSizesRepeatTheirLastColumnAndRow) {
  Image odd{3, 3, {"Y"}, {}};
  for (int i = 0; i < 9; ++i) odd.pixels.push_back(linearFromSrgb8()[size_t(i) * 20]);
  Image even{4, 4, {"Y"}, {}};
  for (uint32_t y = 0; y < 4; ++y)
    for (uint32_t x = 0; x < 4; ++x) even.pixels.push_back(odd.at(std::min(x, 2u), std::min(y, 2u), 0));
  EXPECT_EQ(yuv420(odd), yuv420(even));
  EXPECT_EQ(yuv420(evenly(1, 1, {0.5f, 0, 0})), yuv420(evenly(2, 2, {0.5f, 0, 0})));
}

TEST(Yuv, chromaLiesOnTheLeftPixelOfAPair) {
  // Blue from column 4 on: the sample at column 4 is three quarters blue, and its left neighbour not at all.
  Image image{8, 2, {"R", "G", "B"}, std::vector<float>(8 * 2 * 3, 0.0f)};
  for (uint32_t y = 0; y < 2; ++y)
    for (uint32_t x = 4; x < 8; ++x) image.pixels[(y * 8 + x) * 3 + 2] = 1;
  const std::vector<uint8_t> planes = yuv420(image);
  const uint8_t* blue = planes.data() + 16;
  EXPECT_EQ(blue[1], 128);
  EXPECT_EQ(blue[2], 128 + 112 * 3 / 4);
  EXPECT_EQ(blue[3], 128 + 112);
}

TEST(Yuv, alphaIsOverBlackInLinearLight) {
  EXPECT_EQ(yuv420(evenly(2, 2, {0.8f, 0.4f, 0.2f, 0.5f})), yuv420(evenly(2, 2, {0.4f, 0.2f, 0.1f})));
  EXPECT_EQ(yuv420(evenly(2, 2, {0.8f, 0.4f, 0.2f, NAN})), yuv420(evenly(2, 2, {0, 0, 0})));
  EXPECT_EQ(yuv420(evenly(2, 2, {NAN, -INFINITY, INFINITY, 7})), yuv420(evenly(2, 2, {0, 0, 1})));
}

}  // namespace
}  // namespace scumble::film
