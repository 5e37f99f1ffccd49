#include "measure/cooccurrence.h"

#include <gtest/gtest.h>

#include <functional>

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

// Two levels, 1 and -1, whose pairs can be counted by hand. In a picture of 64 pixels the last row or column
// changes shares by up to a sixty-fourth.
constexpr double kBorder = 1.0 / 64;

Field twoLevels(const std::function<bool(int, int)>& isHigh, double height = 1) {
  return fieldFrom(64, 64, [&](double x, double y) { return isHigh(int(x), int(y)) ? height : -height; });
}
const Field kStripes = twoLevels([](int x, int) { return x % 2 == 0; }),
            kBoard = twoLevels([](int x, int y) { return (x + y) % 2 == 0; });

TEST(CooccurrenceError, countsPairsInFourDirectionsAtFourDistances) {
  // One pixel apart, three of four directions across stripes meet the other level, and two of four on the
  // board; 2, 4 and 8 pixels apart all levels are alike.
  EXPECT_NEAR(errorOf(kStripes, kBoard), 0.25 / 4, kBorder / 4);
  // Stripes twice as wide, one apart: half of the three meet the other level. Two apart: all of the three,
  // none before. 4 and 8 apart: none.
  const Field wide = twoLevels([](int x, int) { return x / 2 % 2 == 0; });
  EXPECT_NEAR(errorOf(kStripes, wide), (3.0 / 8 + 3.0 / 4) / 4, kBorder);
  // Four times: a quarter, half, all.
  const Field widest = twoLevels([](int x, int) { return x / 4 % 2 == 0; });
  EXPECT_NEAR(errorOf(kStripes, widest), (3.0 / 4 * (3.0 / 4) + 3.0 / 8 + 3.0 / 4) / 4, kBorder);
}

TEST(CooccurrenceError, levelsAreSixteenthsOfFiveStandardDeviations) {
  // 1 is in the twelfth of 16 levels from -2.5 to 2.5: from 0.9375 to 1.25.
  for (const auto& [height, error] : {std::pair(0.93, 1.0), {0.95, 0.0}, {1.24, 0.0}, {1.26, 1.0}})
    EXPECT_NEAR(errorOf(kStripes, twoLevels([](int x, int) { return x % 2 == 0; }, height)), error, 1e-9)
        << height;
}

TEST(CooccurrenceError, takesChannelsAloneAndPairsOnOneSurface) {
  Field both(64, 64, 2), same(64, 64, 2);
  both.valid = same.valid = kStripes.valid;
  for (size_t pixel = 0; pixel < both.pixelCount(); ++pixel) {
    both.at(pixel)[0] = same.at(pixel)[0] = same.at(pixel)[1] = *kStripes.at(pixel);
    both.at(pixel)[1] = *kBoard.at(pixel);
  }
  EXPECT_NEAR(errorOf(same, both), 0.25 / 4 / 2, kBorder / 8) << "one of two channels";
  // Columns on two surfaces: only pairs along them count, which are alike in stripes and not on the board.
  Field stripes = kStripes, board = kBoard;
  for (size_t pixel = 0; pixel < board.pixelCount(); ++pixel) {
    stripes.depth.push_back(pixel % 2 ? 1.1f : 1.0f);
    board.depth.push_back(pixel % 2 ? 1.1f : 1.0f);
  }
  EXPECT_NEAR(errorOf(stripes, board), 1.0 / 4, 1e-9);
}

}  // namespace
}  // namespace scumble::measuring
