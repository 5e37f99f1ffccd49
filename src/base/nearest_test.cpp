#include "scumble/nearest.h"

#include <gtest/gtest.h>

namespace scumble {
namespace {

TEST(Nearest, findsSlipsAndOnlySlips) {
  const std::vector<std::string> words{"warp.amount", "warp.inflation", "blur.radius"};
  EXPECT_EQ(nearest("warp.amont", words), "warp.amount");
  EXPECT_EQ(nearest("blur.radii", words), "blur.radius");
  EXPECT_EQ(nearest("zzzz", words), "");
  EXPECT_EQ(nearest("", words), "");
  EXPECT_EQ(nearest(std::string(100000, 'x'), words), "");
}

}  // namespace
}  // namespace scumble
