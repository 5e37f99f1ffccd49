#include "measure/cooccurrence.h"

#include <gtest/gtest.h>

#include "measure/test_fields.h"

namespace scumble::measuring {
namespace {

using namespace test;

Field noise(int frequency, uint32_t seed, float contrast = 1) {
  const std::vector<float> values = selfSimilarNoise(256, frequency, 3, 0.6f, seed);
  return fieldFrom(256, 256,
                   [&](double x, double y) { return contrast * values[size_t(y) * 256 + size_t(x)]; });
}

double errorOf(const Field& example, const Field& field) {
  return cooccurrenceError({&example, 1}, {&field, 1});
}

TEST(CooccurrenceError, isZeroForTheExample) {
  EXPECT_EQ(errorOf(noise(16, 1), noise(16, 1)), 0);
}

TEST(CooccurrenceError, isSmallForMoreOfTheSame) {
  EXPECT_LT(errorOf(noise(16, 1), noise(16, 2)), 0.15);
  EXPECT_LT(errorOf(noise(16, 1), masked(noise(16, 1), 100)), 0.15);
}

TEST(CooccurrenceError, growsWithScaleAndContrast) {
  const Field example = noise(16, 1);
  const double same = errorOf(example, noise(16, 2)), coarser = errorOf(example, noise(8, 1)),
               muchCoarser = errorOf(example, noise(4, 1)), fainter = errorOf(example, noise(16, 1, 0.5f));
  EXPECT_GT(coarser, 1.5 * same);
  EXPECT_GT(muchCoarser, coarser);
  EXPECT_GT(fainter, 2 * same);
}

TEST(CooccurrenceError, doesNotMindBeingTurned) {
  const std::vector<float> values = selfSimilarNoise(256, 16, 3, 0.6f, 1, 4.0f);
  const auto field = [&](bool turned) {
    return fieldFrom(256, 256, [&](double x, double y) {
      return values[size_t(turned ? x : y) * 256 + size_t(turned ? y : x)];
    });
  };
  EXPECT_NEAR(errorOf(field(false), field(true)), 0, 1e-12);
}

TEST(CooccurrenceError, isOneWhereNothingIsInCommon) {
  EXPECT_NEAR(errorOf(noise(16, 1), fieldFrom(256, 256, [](double, double) { return 100.0; })), 1, 0.01);
  EXPECT_EQ(errorOf(noise(16, 1), masked(noise(16, 1), -1)), 1);
  EXPECT_EQ(cooccurrenceError({}, {}), 1);
}

}  // namespace
}  // namespace scumble::measuring
