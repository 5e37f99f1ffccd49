#include "base/tileable_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

namespace scumble {
namespace {

// From a second implementation (PCG's "rxs m xs" in Python): shaders compute the same hash, so it may never
// change.
TEST(TileableNoise, hashIsTheOneThatEveryMachineHas) {
  EXPECT_EQ(hash(0), 0x07bb2fe2u);
  EXPECT_EQ(hash(1), 0xa8beea3cu);
  EXPECT_EQ(hash(2), 0x7a7ecc88u);
  EXPECT_EQ(hash(12345), 0xf45ead0eu);
  EXPECT_EQ(hash(0xffffffffu), 0xe62a4902u);
}

// The permutation is a bijection, and each bit of the input turns about half of the output's bits.
TEST(TileableNoise, hashMixesWell) {
  std::set<uint32_t> seen;
  for (uint32_t i = 0; i < 20000; ++i) seen.insert(hash(i));
  EXPECT_EQ(seen.size(), 20000u);
  for (uint32_t bit = 0; bit < 32; ++bit) {
    int turned = 0;
    for (uint32_t i = 0; i < 2000; ++i) turned += std::popcount(hash(i) ^ hash(i ^ 1u << bit));
    EXPECT_NEAR(turned / 2000.0, 16, 1.5) << "bit " << bit;
  }
}

TEST(TileableNoise, gradientNoiseRepeatsAfterItsPeriods) {
  for (const uint32_t periodX : {1u, 2u, 5u, 8u})
    for (const uint32_t periodY : {1u, 3u, 8u})
      for (int i = 0; i < 50; ++i) {
        // Sixteenths are exact in a float, so the repetition must be exact, too.
        const float x = float(hash(uint32_t(i)) % 256) / 16, y = float(hash(uint32_t(i) + 99) % 256) / 16;
        const float here = gradientNoise(x, y, periodX, periodY, 7);
        EXPECT_EQ(here, gradientNoise(x + float(periodX), y, periodX, periodY, 7));
        EXPECT_EQ(here, gradientNoise(x, y - 4 * float(periodY), periodX, periodY, 7));
      }
}

TEST(TileableNoise, gradientNoiseIsSmoothBoundedAndFollowsTheSeed) {
  int different = 0;
  for (int i = 0; i < 4000; ++i) {
    const float x = float(hash(uint32_t(i)) % 6400) / 800, y = float(hash(uint32_t(i) + 5000) % 6400) / 800;
    const float here = gradientNoise(x, y, 8, 8, 1);
    EXPECT_LE(std::abs(here), 1.05f);
    // Steepest possible slope: gradients of length 1 in the corners and the fade's 15/8, times the scale
    // of 1.41.
    EXPECT_NEAR(here, gradientNoise(x + 1e-3f, y, 8, 8, 1), 6e-3f);
    different += std::abs(here - gradientNoise(x, y, 8, 8, 2)) > 0.01f;
  }
  EXPECT_GT(different, 3600);
  // At the corners of cells, gradient noise is nought.
  EXPECT_EQ(gradientNoise(3, 5, 8, 8, 1), 0.0f);
}

struct FieldMoments {
  double mean = 0, deviation = 0;
};
FieldMoments momentsOf(const std::vector<float>& field) {
  double sum = 0, squares = 0;
  for (const float f : field) sum += f, squares += double(f) * f;
  const double mean = sum / double(field.size());
  return {mean, std::sqrt(squares / double(field.size()) - mean * mean)};
}

TEST(TileableNoise, selfSimilarNoiseHasMeanNoughtAndDeviationOne) {
  for (const float stretch : {1.0f, 4.0f, 0.25f}) {
    const std::vector<float> field = selfSimilarNoise(64, 4, 4, 0.6f, 11, stretch);
    ASSERT_EQ(field.size(), 64u * 64);
    const FieldMoments moments = momentsOf(field);
    EXPECT_NEAR(moments.mean, 0, 1e-6) << stretch;
    EXPECT_NEAR(moments.deviation, 1, 1e-5) << stretch;
  }
}

// Largest difference between neighbours inside the square, and across its border.
TEST(TileableNoise, selfSimilarNoiseHasNoSeam) {
  constexpr uint32_t kSize = 128;
  const std::vector<float> field = selfSimilarNoise(kSize, 4, 3, 0.5f, 3);
  const auto at = [&](uint32_t x, uint32_t y) { return field[size_t(y % kSize) * kSize + x % kSize]; };
  float inside = 0, across = 0;
  for (uint32_t i = 0; i < kSize; ++i) {
    for (uint32_t j = 0; j + 1 < kSize; ++j)
      inside = std::max({inside, std::abs(at(j + 1, i) - at(j, i)), std::abs(at(i, j + 1) - at(i, j))});
    across = std::max(
        {across, std::abs(at(kSize, i) - at(kSize - 1, i)), std::abs(at(i, kSize) - at(i, kSize - 1))});
  }
  EXPECT_LE(across, inside * 1.05f);
  EXPECT_GT(across, 0.0f);
}

TEST(TileableNoise, selfSimilarNoiseIsTheSameEveryTimeAndAnotherForAnotherSeed) {
  EXPECT_EQ(selfSimilarNoise(32, 2, 3, 0.5f, 5), selfSimilarNoise(32, 2, 3, 0.5f, 5));
  EXPECT_NE(selfSimilarNoise(32, 2, 3, 0.5f, 5), selfSimilarNoise(32, 2, 3, 0.5f, 6));
}

TEST(TileableNoise, stretchMakesFeaturesLongAlongV) {
  constexpr uint32_t kSize = 64;
  const auto steepness = [](float stretch) {
    const std::vector<float> field = selfSimilarNoise(kSize, 8, 1, 0.5f, 21, stretch);
    double alongU = 0, alongV = 0;
    for (uint32_t y = 0; y + 1 < kSize; ++y)
      for (uint32_t x = 0; x + 1 < kSize; ++x) {
        alongU += std::abs(field[y * kSize + x + 1] - field[y * kSize + x]);
        alongV += std::abs(field[(y + 1) * kSize + x] - field[y * kSize + x]);
      }
    return alongU / alongV;
  };
  EXPECT_NEAR(steepness(1), 1, 0.25);
  EXPECT_NEAR(steepness(4), 4, 1.2);
}

// What holds after a wrong period would still repeat: noise with firstPeriod cells has that many features an
// edge.
TEST(TileableNoise, firstPeriodSetsTheSizeOfTheLargestFeatures) {
  // Over several seeds: one pattern of four cells an edge is too few to count on.
  const auto crossings = [](uint32_t period) {
    int count = 0;
    for (uint32_t seed = 0; seed < 12; ++seed) {
      const std::vector<float> field = selfSimilarNoise(128, period, 1, 0.5f, seed * 31);
      for (uint32_t y = 0; y < 128; ++y)
        for (uint32_t x = 0; x + 1 < 128; ++x)
          count += (field[y * 128 + x] > 0) != (field[y * 128 + x + 1] > 0);
    }
    return double(count);
  };
  EXPECT_NEAR(crossings(16) / crossings(4), 4, 0.8);
}

}  // namespace
}  // namespace scumble
