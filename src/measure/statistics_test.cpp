#include "measure/statistics.h"

#include <gtest/gtest.h>

#include "measure/test_fields.h"

namespace scumble::measuring {
namespace {

using namespace test;

double frequencyOf(const Field& field) {
  return dominantFrequency({&field, 1});
}

TEST(Spread, isTheStandardDeviation) {
  const Field noise = whiteNoise(128, 3), some = masked(noise, 40);
  EXPECT_NEAR(spread({&noise, 1}), 1, 0.02);
  EXPECT_NEAR(spread({&some, 1}), 1, 0.03);
  const Field flat = sines(16, 0);
  EXPECT_EQ(spread({&flat, 1}), 0);
  EXPECT_EQ(spread({}), 0);
}

TEST(Spread, takesFieldsAndChannelsTogether) {
  Field low(2, 1, 2), high(2, 1, 2);
  low.valid = high.valid = {1, 1};
  high.values = {2, 4, 2, 4};
  const Field both[] = {low, high};
  EXPECT_NEAR(spread(both), std::sqrt(1.0 + 4.0), 1e-12);
}

TEST(Difference, isZeroForTheSameAndOneForUnrelatedFields) {
  const Field a = whiteNoise(128, 1), b = whiteNoise(128, 2);
  EXPECT_EQ(difference(a, a).relative, 0);
  EXPECT_NEAR(difference(a, b).relative, 1, 0.02);
  EXPECT_NEAR(difference(a, b).rms, std::numbers::sqrt2, 0.03);
}

TEST(Difference, ofAShiftedSineIsKnown) {
  // cos and its shift by a fifth of a period differ by 2 sin(pi / 5) sin(...); sines along y do not change.
  const Field a = sines(100, 0.05), b = sines(100, 0.05, 4);
  EXPECT_NEAR(difference(a, b).rms, std::numbers::sqrt2 * std::sin(std::numbers::pi / 5), 1e-4);
}

TEST(Difference, countsWhatIsValidInBoth) {
  const Field a = masked(whiteNoise(64, 1), 20);
  Field b = a;
  b.values[0] = 1000;
  const FieldDifference same = difference(a, b);
  EXPECT_EQ(same.rms, 0);
  EXPECT_EQ(same.pixels, a.validCount());
  EXPECT_EQ(difference(a, masked(b, -1)).pixels, 0u);
}

TEST(DominantFrequency, ofSinesIsTheirs) {
  for (const double frequency : {0.01, 0.02, 0.1, 0.2}) {
    const Field sine = fieldFrom(400, 400, [&](double x, double y) {
      const double turn = 2 * std::numbers::pi * frequency;
      return std::cos(turn * x) * std::cos(turn * y);
    });
    EXPECT_NEAR(frequencyOf(sine) / frequency, 1, 0.05) << frequency;
  }
}

TEST(DominantFrequency, isThatOfTheMeanLag) {
  // Lags of 1 / (6 f): 10 pixels along x, 2.5 along y.
  const Field sine = fieldFrom(240, 240, [](double x, double y) {
    return std::cos(2 * std::numbers::pi * x / 60) * std::cos(2 * std::numbers::pi * y / 15);
  });
  EXPECT_NEAR(frequencyOf(sine) * 6 * (10 + 2.5) / 2, 1, 0.03);
}

TEST(DominantFrequency, ofWhiteNoiseIsAQuarter) {
  EXPECT_NEAR(frequencyOf(whiteNoise(200, 5)), 0.25, 0.01);
}

TEST(DominantFrequency, followsMagnification) {
  // The same noise 1, 2, 4 and 8 times as large, through a round hole.
  const std::vector<float> noise = selfSimilarNoise(256, 32, 3, 0.6f, 9);
  const auto at = [&](double scale, int seed) {
    return masked(fieldFrom(300, 200,
                            [&](double x, double y) {
                              const auto texel = [&](double v) {
                                return size_t(int64_t(v + 57 * seed) & 255);
                              };
                              return noise[texel(y / scale) * 256 + texel(x / scale)];
                            }),
                  90);
  };
  double before = 0;
  for (const double scale : {1.0, 2.0, 4.0, 8.0}) {
    const Field several[] = {at(scale, 0), at(scale, 1), at(scale, 2), at(scale, 3)};
    const double frequency = dominantFrequency(several);
    if (before > 0) {
      EXPECT_NEAR(before / frequency, 2, 0.25) << scale;
    }
    before = frequency;
  }
}

TEST(DominantFrequency, isThatOfSurfacesAndNotOfTheirEdges) {
  // Stripes of two surfaces, each with sines of its own.
  const auto stripe = [](double x) { return int(x / 5) % 2; };
  Field striped = fieldFrom(200, 200, [&](double x, double y) {
    return std::cos(0.2 * x + 2 * stripe(x)) * std::cos(0.2 * y + 2 * stripe(x));
  });
  const double mixed = frequencyOf(striped);
  for (size_t pixel = 0; pixel < striped.pixelCount(); ++pixel)
    striped.depth.push_back(stripe(double(pixel % 200) + 0.5) ? 1.0f : 1.1f);
  EXPECT_NEAR(frequencyOf(striped) * 2 * std::numbers::pi, 0.2, 0.02);
  EXPECT_GT(mixed, 1.3 * frequencyOf(striped));
}

TEST(DominantFrequency, isNoneWhereNothingVaries) {
  EXPECT_EQ(frequencyOf(sines(32, 0)), 0);
  EXPECT_EQ(frequencyOf(masked(whiteNoise(32, 1), -1)), 0);
  EXPECT_EQ(dominantFrequency({}), 0);
}

}  // namespace
}  // namespace scumble::measuring
