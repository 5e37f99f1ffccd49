// Statistics of pictures and their Gaussian twins, by sorting and by adding up (Heitz and Neyret 2018).
#include "world/histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace scumble::world {
namespace {

// Red: all values equally often. Green: two values, the rarer one below. Blue: the sum of twelve dice, nearly
// Gaussian. Alpha: one value.
Pixels kindsOfHistograms() {
  Pixels pixels{128, 64, {}};
  uint32_t state = 12345;
  const auto random = [&] {
    state = state * 1664525u + 1013904223u;
    return state >> 24;
  };
  for (uint32_t i = 0; i < 128 * 64; ++i) {
    uint32_t sum = 0;
    for (int k = 0; k < 12; ++k) sum += random();
    pixels.rgba.insert(pixels.rgba.end(), {uint8_t(i * 37), uint8_t(i % 4 == 1 ? 20 : 200),
                                           uint8_t(sum / 24 + 64), uint8_t(255)});
  }
  return pixels;
}

std::vector<double> valuesOf(const Pixels& pixels, size_t channel) {
  std::vector<double> values;
  for (size_t i = channel; i < pixels.rgba.size(); i += 4) values.push_back(pixels.rgba[i] / 255.0);
  return values;
}
double meanOfValues(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / double(values.size());
}
double deviationOf(const std::vector<double>& values) {
  const double mean = meanOfValues(values);
  double sum = 0;
  for (const double v : values) sum += (v - mean) * (v - mean);
  return std::sqrt(sum / double(values.size()));
}

// The integral of the bell curve up to x, by Simpson's rule.
double bellUpTo(double x) {
  constexpr int kSteps = 2000;
  const double low = -9, h = (std::clamp(x, low, 9.0) - low) / kSteps;
  double sum = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const double at = low + i * h;
    sum += std::exp(-0.5 * at * at) * (i == 0 || i == kSteps ? 1 : i % 2 ? 4 : 2);
  }
  return sum * h / 3 / std::sqrt(2 * 3.14159265358979);
}

// The greatest distance between both cumulative curves, half a step above each value.
double distanceToBell(std::vector<double> values) {
  const double mean = meanOfValues(values), deviation = deviationOf(values);
  std::sort(values.begin(), values.end());
  double most = 0;
  for (int code = 0; code < 256; ++code) {
    const double at = (code + 0.5) / 255;
    const auto upTo = std::upper_bound(values.begin(), values.end(), at);
    most = std::max(most, std::abs(double(upTo - values.begin()) / double(values.size()) -
                                   bellUpTo((at - mean) / deviation)));
  }
  return most;
}

TEST(Histogram, meanDeviationAndDistanceToAGaussian) {
  const Pixels pixels = kindsOfHistograms();
  const Statistics statistics = measure(pixels);
  for (int c = 0; c < 4; ++c) {
    const std::vector<double> values = valuesOf(pixels, size_t(c));
    EXPECT_NEAR(statistics.mean[c], meanOfValues(values), 1e-6) << c;
    EXPECT_NEAR(statistics.deviation[c], deviationOf(values), 1e-6) << c;
    if (c < 3) {
      EXPECT_NEAR(statistics.distanceToGaussian[c], distanceToBell(values), 1e-5) << c;
    }
  }
  // By hand: a uniform histogram, and a quarter and three quarters.
  EXPECT_NEAR(statistics.mean.x, 0.5, 1e-6);
  EXPECT_NEAR(statistics.deviation.x, 1 / std::sqrt(12.0), 2e-3);
  EXPECT_NEAR(statistics.distanceToGaussian.x, 0.058, 0.004);
  EXPECT_NEAR(statistics.mean.y, 155 / 255.0, 1e-6);
  EXPECT_NEAR(statistics.deviation.y, std::sqrt(3.0) / 4 * 180 / 255, 1e-6);
  EXPECT_GT(statistics.distanceToGaussian.y, 0.3f);
  EXPECT_LT(statistics.distanceToGaussian.z, 0.03f);
  EXPECT_EQ(statistics.deviation.w, 0);
  EXPECT_EQ(statistics.distanceToGaussian.w, 0);
}

TEST(Histogram, ofNothing) {
  const Statistics statistics = measure({0, 0, {}});
  EXPECT_EQ(statistics.mean, glm::vec4(0));
  EXPECT_EQ(statistics.deviation, glm::vec4(0));
}

// Every value stands at the middle of its ranks in a Gaussian of mean 0.5 and deviation 1/6.
TEST(Histogram, twinsAreGaussianByRank) {
  const Pixels pixels = kindsOfHistograms();
  const GaussianTwin twin = gaussianTwin(pixels);
  ASSERT_EQ(twin.pixels.rgba.size(), pixels.rgba.size());
  EXPECT_EQ(twin.pixels.width, pixels.width);
  for (size_t c = 0; c < 4; ++c) {
    const std::vector<double> own = valuesOf(pixels, c), gaussian = valuesOf(twin.pixels, c);
    std::vector<double> sorted = own;
    std::sort(sorted.begin(), sorted.end());
    // A code is 1.5 percent of a deviation of 1/6, and its middle half of that away at most.
    size_t checked = 0;
    for (size_t i = 0; i < own.size(); i += 61, ++checked) {
      const auto [low, high] = std::equal_range(sorted.begin(), sorted.end(), own[i]);
      const double rank = 0.5 * double((low - sorted.begin()) + (high - sorted.begin())) / double(own.size());
      const double before = bellUpTo((gaussian[i] - 0.5 - 0.51 / 255) * 6),
                   after = bellUpTo((gaussian[i] - 0.5 + 0.51 / 255) * 6);
      // At both ends values stop at 0 and 1.
      if (gaussian[i] > 0) {
        EXPECT_GE(rank, before) << c << " " << own[i];
      }
      if (gaussian[i] < 1) {
        EXPECT_LE(rank, after) << c << " " << own[i];
      }
    }
    EXPECT_GT(checked, 100u);
  }
  EXPECT_NEAR(meanOfValues(valuesOf(twin.pixels, 0)), 0.5, 2e-3);
  EXPECT_NEAR(deviationOf(valuesOf(twin.pixels, 0)), 1 / 6.0, 2e-3);
  EXPECT_NEAR(meanOfValues(valuesOf(twin.pixels, 2)), 0.5, 2e-3);
  EXPECT_NEAR(deviationOf(valuesOf(twin.pixels, 2)), 1 / 6.0, 2e-3);
}

// The way back: where so much of the Gaussian lies below, so many of the picture's values do.
TEST(Histogram, inverseLeadsBack) {
  const Pixels pixels = kindsOfHistograms();
  const GaussianTwin twin = gaussianTwin(pixels);
  for (size_t c = 0; c < 4; ++c) {
    std::vector<uint8_t> sorted;
    for (size_t i = c; i < pixels.rgba.size(); i += 4) sorted.push_back(pixels.rgba[i]);
    std::sort(sorted.begin(), sorted.end());
    for (int code = 0; code < 256; ++code) {
      const double rank = bellUpTo((code / 255.0 - 0.5) * 6) * double(sorted.size());
      const auto valueAt = [&](double at) {
        return sorted[size_t(std::clamp(at, 0.0, double(sorted.size() - 1)))];
      };
      // Ranks are compared in floating point: either side of a whole number.
      const int got = twin.inverse[size_t(code)][int(c)];
      EXPECT_TRUE(got == valueAt(std::ceil(rank - 1e-3) - 1) || got == valueAt(std::ceil(rank + 1e-3) - 1))
          << c << " " << code << ": " << got << " at rank " << rank;
    }
    // From a value to its twin and back: itself, where its neighbours have other codes.
    size_t same = 0, count = 0;
    for (size_t i = c; i < pixels.rgba.size(); i += 4, ++count)
      same += std::abs(int(twin.inverse[twin.pixels.rgba[i]][int(c)]) - int(pixels.rgba[i])) <= 3;
    EXPECT_GT(double(same), 0.99 * double(count)) << c;
  }
}

}  // namespace
}  // namespace scumble::world
