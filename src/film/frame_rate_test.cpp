#include "film/frame_rate.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scumble::film {
namespace {

TEST(FrameRate, whatPeopleWriteIsWhatTheyMean) {
  const struct {
    double fps;
    int numerator, denominator;
  } cases[] = {{24, 24, 1},
               {1, 1, 1},
               {1000, 1000, 1},
               {23.976, 24000, 1001},
               {23.98, 24000, 1001},
               {24000.0 / 1001, 24000, 1001},
               {29.97, 30000, 1001},
               {59.94, 60000, 1001},
               {119.88, 120000, 1001},
               {12.5, 25, 2},
               {0.5, 1, 2},
               {0.01, 1, 100},
               {1.0 / 3, 1, 3},
               {0.999, 999, 1000},
               {23.9, 239, 10}};
  for (const auto& c : cases) {
    const FrameRate rate = frameRateOf(c.fps);
    EXPECT_EQ(rate.numerator, c.numerator) << c.fps;
    EXPECT_EQ(rate.denominator, c.denominator) << c.fps;
  }
}

TEST(FrameRate, isNearEverywhere) {
  for (double fps = 0.01; fps < 1000; fps *= 1.0137) {
    const FrameRate rate = frameRateOf(fps);
    ASSERT_GT(rate.numerator, 0);
    ASSERT_LE(rate.denominator, 1001);
    EXPECT_NEAR(double(rate.numerator) / rate.denominator, fps, 5e-3) << fps;
  }
}

}  // namespace
}  // namespace scumble::film
