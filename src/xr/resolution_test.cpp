// As many pixels as there is time for, in few steps.
#include "xr/resolution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>

namespace scumble::xr {
namespace {

constexpr double kPeriod = 1000.0 / 90;

TEST(ResolutionOfEyes, framesThatAreLateHaveFewerPixels) {
  Resolution resolution(std::nullopt);
  EXPECT_EQ(resolution.scale(), 1);
  // One is not.
  resolution.took(20, kPeriod);
  resolution.took(5, kPeriod);
  EXPECT_EQ(resolution.scale(), 1);
  for (int i = 0; i < 3; ++i) resolution.took(20, kPeriod);
  EXPECT_EQ(resolution.scale(), 0.9f);
  EXPECT_FALSE(resolution.isTooMuch());
  EXPECT_EQ(resolution.of({2064, 2208}), glm::uvec2(1858, 1987));
  // No more than there is.
  for (int i = 0; i < 100; ++i) resolution.took(1000, kPeriod);
  EXPECT_EQ(resolution.scale(), 0.5f);
  EXPECT_TRUE(resolution.isTooMuch());
  EXPECT_EQ(resolution.of({1, 1}), glm::uvec2(1, 1));
}

TEST(ResolutionOfEyes, pixelsComeBackWhenThereIsTime) {
  Resolution resolution(std::nullopt);
  for (int i = 0; i < 6; ++i) resolution.took(20, kPeriod);
  const float low = resolution.scale();
  for (int i = 0; i < 89; ++i) resolution.took(2, kPeriod);
  EXPECT_EQ(resolution.scale(), low);
  resolution.took(2, kPeriod);
  EXPECT_GT(resolution.scale(), low);
  for (int i = 0; i < 1000; ++i) resolution.took(2, kPeriod);
  EXPECT_EQ(resolution.scale(), 1);
}

// A device whose time is that of its pixels finds its step, and stays there.
TEST(ResolutionOfEyes, itDoesNotGoToAndFro) {
  for (double whole = 2; whole < 40; whole += 0.37) {
    Resolution resolution(std::nullopt);
    int changes = 0;
    for (int i = 0; i < 2000; ++i) {
      const float before = resolution.scale();
      resolution.took(whole * before * before, kPeriod);
      if (i > 500) changes += resolution.scale() != before;
    }
    EXPECT_EQ(changes, 0) << whole;
    const float scale = resolution.scale();
    EXPECT_TRUE(whole * scale * scale <= 0.85 * kPeriod || scale == 0.5f) << whole;
  }
  // Steps are even, as pixels count.
  for (size_t i = 1; i < std::size(Resolution::kSteps); ++i)
    EXPECT_NEAR(std::pow(Resolution::kSteps[i] / Resolution::kSteps[i - 1], 2), 0.8, 0.04);
}

TEST(ResolutionOfEyes, whatIsFixedStays) {
  Resolution resolution(0.75f);
  for (int i = 0; i < 10; ++i) resolution.took(100, kPeriod);
  EXPECT_EQ(resolution.of({2000, 1000}), glm::uvec2(1500, 750));
  // And nobody knows how long a frame takes where the runtime or the device does not tell.
  Resolution unknown(std::nullopt);
  for (int i = 0; i < 10; ++i) unknown.took(0, kPeriod), unknown.took(100, 0);
  EXPECT_EQ(unknown.scale(), 1);
}

}  // namespace
}  // namespace scumble::xr
