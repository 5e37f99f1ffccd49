#include "measure/field.h"

#include <gtest/gtest.h>

#include "measure/test_fields.h"

namespace scumble::measuring {
namespace {

using namespace test;

Places shifted(int size, float byX) {
  Places places(size, size, 2);
  for (size_t pixel = 0; pixel < places.pixelCount(); ++pixel) {
    const size_t column = pixel % size_t(size), row = pixel / size_t(size);
    places.at(pixel)[0] = float(column) + 0.5f + byX;
    places.at(pixel)[1] = float(row) + 0.5f;
    places.valid[pixel] = 1;
  }
  return places;
}

TEST(Field, ofAPictureCountsWhereTheMaskIsAboveZero) {
  const Image image{2, 1, {"R", "G", "B", "A"}, {1, 2, 3, 0, 4, 5, 6, 0.5f}};
  const Field field = fieldOf(image, 1, 2, image, 3, 10);
  EXPECT_EQ(field.channels, 2);
  EXPECT_EQ(field.values, (std::vector<float>{20, 30, 50, 60}));
  EXPECT_EQ(field.valid, (std::vector<uint8_t>{0, 1}));
  EXPECT_EQ(field.validCount(), 1u);
}

TEST(Field, whatIsNotFiniteDoesNotCount) {
  const Image image{2, 1, {"R"}, {NAN, 1}}, mask{2, 1, {"R"}, {1, 1}};
  EXPECT_EQ(fieldOf(image, 0, 1, mask, 0).valid, (std::vector<uint8_t>{0, 1}));
}

TEST(SampleAt, pixelCentresGiveTheFieldItself) {
  const Field noise = whiteNoise(24, 1), sampled = sampleAt(noise, shifted(24, 0));
  EXPECT_EQ(sampled.values, noise.values);
  EXPECT_EQ(sampled.validCount(), noise.pixelCount());
}

TEST(SampleAt, sinesBetweenPixelsKeepTheirShape) {
  for (const double frequency : {0.05, 0.15, 0.25}) {
    const Field sampled = sampleAt(sines(32, frequency), shifted(32, 0.5f)),
                expected = sines(32, frequency, -0.5);
    ASSERT_GT(sampled.validCount(), 500u);
    for (size_t pixel = 0; pixel < sampled.pixelCount(); ++pixel)
      if (sampled.valid[pixel]) {
        EXPECT_NEAR(*sampled.at(pixel), *expected.at(pixel), 0.03) << frequency;
      }
  }
}

TEST(SampleAt, needsAllPixelsAround) {
  Field flat = sines(16, 0);
  flat.valid[8 * 16 + 8] = 0;
  const Field sampled = sampleAt(flat, shifted(16, 0.5f));
  for (int x = 0; x < 16; ++x) {
    const bool inside = x >= 2 && x + 3 < 16, besideHole = x + 3 >= 8 && x - 2 <= 8;
    EXPECT_EQ(sampled.valid[size_t(8 * 16 + x)], inside && !besideHole) << x;
    EXPECT_EQ(sampled.valid[size_t(3 * 16 + x)], inside) << x;
  }
}

}  // namespace
}  // namespace scumble::measuring
