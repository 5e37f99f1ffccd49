#include "film/compare.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scumble::film {
namespace {

constexpr uint32_t kSize = 128;

// Discs on a gradient: areas, edges, and hues.
Image scene(float shift) {
  Image image{kSize, kSize, {"R", "G", "B"}, {}};
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x) {
      const float u = (float(x) + shift) / kSize, v = float(y) / kSize;
      float color[3] = {0.2f + 0.4f * v, 0.3f + 0.2f * v, 0.6f - 0.3f * v};
      if (std::hypot(u - 0.35f, v - 0.4f) < 0.2f) color[0] = 0.8f, color[1] = 0.15f, color[2] = 0.1f;
      if (std::hypot(u - 0.7f, v - 0.65f) < 0.15f) color[0] = color[1] = color[2] = 0.03f;
      image.pixels.insert(image.pixels.end(), color, color + 3);
    }
  return image;
}

Image noisy(float amount) {
  Image image = scene(0);
  uint32_t state = 7;
  for (float& v : image.pixels)
    v += amount * (float((state = state * 1664525 + 1013904223) >> 8) / float(1 << 23) - 1);
  return image;
}

Image tinted(float red, float green, float blue) {
  Image image = scene(0);
  for (size_t i = 0; i < image.pixels.size(); i += 3) {
    image.pixels[i] *= red;
    image.pixels[i + 1] *= green;
    image.pixels[i + 2] *= blue;
  }
  return image;
}

Image flat(float red, float green, float blue) {
  Image image{kSize, kSize, {"R", "G", "B"}, {}};
  for (uint32_t i = 0; i < kSize * kSize; ++i) image.pixels.insert(image.pixels.end(), {red, green, blue});
  return image;
}

double mean(const Image& image) {
  return comparePictures(scene(0), image).mean;
}

TEST(Compare, samePicturesDoNotDiffer) {
  const Difference none = comparePictures(scene(0), scene(0));
  EXPECT_EQ(none.mean, 0);
  EXPECT_EQ(none.max, 0);
}

TEST(Compare, isSymmetric) {
  const Difference there = comparePictures(scene(0), scene(3)), back = comparePictures(scene(3), scene(0));
  EXPECT_DOUBLE_EQ(there.mean, back.mean);
  EXPECT_DOUBLE_EQ(there.max, back.max);
}

TEST(Compare, largerShiftsDifferMore) {
  EXPECT_GT(mean(scene(0.25f)), 0);
  EXPECT_GT(mean(scene(1)), mean(scene(0.25f)));
  EXPECT_GT(mean(scene(4)), mean(scene(1)));
  EXPECT_GT(mean(scene(16)), mean(scene(4)));
  EXPECT_GT(comparePictures(scene(0), scene(4)).max, 0.5);  // the moved edge is seen
}

TEST(Compare, moreNoiseDiffersMore) {
  EXPECT_GT(mean(noisy(0.02f)), mean(noisy(0.004f)));
  EXPECT_GT(mean(noisy(0.1f)), mean(noisy(0.02f)));
}

TEST(Compare, strongerTintsDifferMore) {
  EXPECT_GT(mean(tinted(1.3f, 1, 1)), mean(tinted(1.1f, 1, 1)));
  EXPECT_GT(mean(tinted(1.1f, 1, 1)), mean(tinted(1.02f, 1, 1)));
}

// What must pass a golden test lies far below what must fail it.
TEST(Compare, roundingOfDriversIsFarBelowWhatAPersonSees) {
  const Image rounding = noisy(1.0f / 255);
  EXPECT_LT(mean(rounding), 0.03);
  EXPECT_LT(comparePictures(scene(0), rounding).max, 0.2);
  EXPECT_GT(mean(tinted(1.3f, 1, 1)), 2 * mean(rounding));
  EXPECT_GT(comparePictures(scene(0), scene(2)).max, 2 * comparePictures(scene(0), rounding).max);
}

// The eye blurs fine noise away; the same change spread evenly stays.
TEST(Compare, fineNoiseIsSeenLessThanAnEvenChangeOfTheSameSize) {
  Image checkered = flat(0.3f, 0.3f, 0.3f), even = checkered;
  for (uint32_t i = 0; i < kSize * kSize; ++i)
    for (int c = 0; c < 3; ++c) {
      checkered.pixels[i * 3 + c] += (i + i / kSize) % 2 ? 0.02f : -0.02f;
      even.pixels[i * 3 + c] += 0.02f;
    }
  const Image gray = flat(0.3f, 0.3f, 0.3f);
  EXPECT_LT(comparePictures(gray, checkered).mean, comparePictures(gray, even).mean);
}

TEST(Compare, extremesReachTheirDocumentedValues) {
  EXPECT_NEAR(comparePictures(flat(0, 1, 0), flat(0, 0, 1)).mean, 1, 1e-3);
  EXPECT_NEAR(comparePictures(flat(0, 0, 0), flat(1, 1, 1)).mean, 0.96, 0.01);
}

// What fills one tile and leaves the rest as it is: the mean hardly sees it.
TEST(Compare, theWorstTileFindsWhatIsWrongInOnePlace) {
  const uint32_t tiles = kSize / kDifferenceTile;
  const Image gray = flat(0.3f, 0.3f, 0.3f);
  for (const uint32_t column : {0u, 3u, tiles - 1})
    for (const uint32_t row : {0u, 5u, tiles - 1}) {
      Image spotted = gray;
      for (uint32_t y = 0; y < kDifferenceTile; ++y)
        for (uint32_t x = 0; x < kDifferenceTile; ++x) {
          const size_t at = (size_t(row * kDifferenceTile + y) * kSize + column * kDifferenceTile + x) * 3;
          spotted.pixels[at] = spotted.pixels[at + 2] = 1, spotted.pixels[at + 1] = 0;
        }
      const Difference difference = comparePictures(gray, spotted);
      EXPECT_LT(difference.mean, 0.03) << column << " " << row;
      EXPECT_GT(difference.tile, 0.7) << column << " " << row;
    }
  // An even change is as large in each tile as in the mean.
  const Difference even = comparePictures(gray, flat(0.4f, 0.3f, 0.3f));
  EXPECT_NEAR(even.tile, even.mean, 1e-6);
}

TEST(Compare, tilesThatTheBorderCutsCountByTheirArea) {
  const auto grays = [](float value) { return Image{20, 16, {"Y"}, std::vector<float>(20 * 16, value)}; };
  Image right = grays(0.2f);
  for (size_t y = 0; y < 16; ++y)
    for (size_t x = 16; x < 20; ++x) right.pixels[y * 20 + x] = 1;
  const double whole = comparePictures(grays(0.2f), grays(1)).mean;
  const double tile = comparePictures(grays(0.2f), right).tile;
  EXPECT_LT(tile, 0.5 * whole);
  EXPECT_GT(tile, 0.1 * whole);
}

TEST(Compare, differentSizesDifferCompletely) {
  const Image small{1, 1, {"R", "G", "B"}, {0, 0, 0}};
  EXPECT_EQ(comparePictures(scene(0), small).mean, 1);
}

TEST(Compare, alphaIsSeenWhateverTheColour) {
  const Image solid{1, 1, {"R", "G", "B", "A"}, {0, 0, 0, 1}},
      clear{1, 1, {"R", "G", "B", "A"}, {0, 0, 0, 0}};
  EXPECT_GT(comparePictures(solid, clear).mean, 0.5);
  const Image white{1, 1, {"R", "G", "B", "A"}, {1, 1, 1, 0}};
  EXPECT_LT(comparePictures(clear, white).mean, 1e-4);  // colours that nobody sees
  // Over black nothing differs: every number is that over white.
  Image tile{kDifferenceTile, kDifferenceTile, {"R", "G", "B", "A"}, {}}, hole = tile;
  tile.pixels.assign(4 * kDifferenceTile * kDifferenceTile, 0.0f), hole.pixels = tile.pixels;
  for (size_t i = 3; i < tile.pixels.size(); i += 4) tile.pixels[i] = 1;
  const Difference cut = comparePictures(tile, hole);
  EXPECT_GT(cut.mean, 0.5);
  EXPECT_GT(cut.tile, 0.5);
  EXPECT_GT(cut.max, 0.5);
}

}  // namespace
}  // namespace scumble::film
