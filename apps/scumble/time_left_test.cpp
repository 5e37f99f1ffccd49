#include "time_left.h"

#include <gtest/gtest.h>

namespace scumble::app {
namespace {

TEST(TimeLeft, isTheRestAtThePaceSoFar) {
  TimeLeft left(100);
  EXPECT_FALSE(left.after(1, 8)) << "the first step compiles what all of them use";
  EXPECT_NEAR(left.after(2, 8.2).value(), 0.2 * 98, 1e-9);
  EXPECT_NEAR(left.after(51, 18).value(), 0.2 * 49, 1e-9);
  EXPECT_EQ(left.after(100, 30), std::optional(0.0));
}

TEST(TimeLeft, isNotToldTooEarly) {
  TimeLeft left(1000);
  EXPECT_FALSE(left.after(0, 0));
  EXPECT_FALSE(left.after(1, 0.5));
  EXPECT_FALSE(left.after(1, 20)) << "there is no pace yet";
  TimeLeft parts(1);
  EXPECT_FALSE(parts.after(0.001, 1));
  EXPECT_FALSE(parts.after(0.02, 2)) << "below three percent, within five seconds";
  EXPECT_TRUE(parts.after(0.02, 5.5));
  EXPECT_TRUE(parts.after(0.04, 3));
}

}  // namespace
}  // namespace scumble::app
