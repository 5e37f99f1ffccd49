// Times of frames, as runtimes tell them.
#include "xr/clock.h"

#include <gtest/gtest.h>

namespace scumble::xr {
namespace {

constexpr XrTime kFrame = 11'111'111;

TEST(ClockOfScenes, goesOnAsFramesAreSeen) {
  Clock clock(2);
  for (int i = 0; i <= 90; ++i) clock.go(5'000'000'000 + i * kFrame, false);
  EXPECT_DOUBLE_EQ(clock.time(), 2 + 90 * 11'111'111e-9);
  EXPECT_DOUBLE_EQ(clock.sinceLast(), 11'111'111e-9);
}

TEST(ClockOfScenes, standsWithoutLosingItsPlace) {
  Clock clock(0);
  XrTime display = 0;
  for (const bool stands : {false, false, true, true, true, false}) clock.go(display += kFrame, stands);
  EXPECT_DOUBLE_EQ(clock.time(), 2 * 11'111'111e-9);
}

// Nobody was there, the runtime's clock has jumped, or it is told backwards.
TEST(ClockOfScenes, gapsAreShort) {
  Clock clock(0);
  clock.go(0, false);
  clock.go(900'000'000'000'000, false);
  EXPECT_DOUBLE_EQ(clock.time(), 1);
  clock.go(800'000'000'000'000, false);
  EXPECT_DOUBLE_EQ(clock.time(), 1);
  EXPECT_EQ(clock.sinceLast(), 0);
}

TEST(ClockOfScenes, endsWhereRenderersDo) {
  Clock clock(Renderer::kMaxTime - 0.5);
  for (int i = 0; i < 5; ++i) clock.go(XrTime(i) * 1'000'000'000, false);
  EXPECT_LT(clock.time(), Renderer::kMaxTime);
  EXPECT_GT(clock.time(), Renderer::kMaxTime - 0.01);
}

}  // namespace
}  // namespace scumble::xr
