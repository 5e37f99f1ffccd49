#include <gtest/gtest.h>

#include "scumble/image.h"

namespace scumble {
namespace {

const Image kLeft{2, 1, {"R", "G"}, {1, 2, 3, 4}};
const Image kRight{2, 1, {"R", "G"}, {5, 6, 7, 8}};

TEST(StereoLayout, sideBySidePutsTheLeftViewLeft) {
  const Image both = sideBySide(kLeft, kRight);
  EXPECT_EQ(both.width, 4u);
  EXPECT_EQ(both.height, 1u);
  EXPECT_EQ(both.channels, kLeft.channels);
  EXPECT_EQ(both.pixels, (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST(StereoLayout, overUnderPutsTheLeftViewOnTop) {
  const Image both = overUnder(kLeft, kRight);
  EXPECT_EQ(both.width, 2u);
  EXPECT_EQ(both.height, 2u);
  EXPECT_EQ(both.pixels, (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST(StereoLayout, rowsOfDifferentPicturesStayApart) {
  const Image tall{1, 2, {"R"}, {1, 2}}, wide{2, 1, {"R"}, {3, 4}};
  EXPECT_EQ(sideBySide(tall, wide).pixels, (std::vector<float>{1, 3, 4, 2, 0, 0}));
  EXPECT_EQ(overUnder(tall, wide).pixels, (std::vector<float>{1, 0, 2, 0, 3, 4}));
}

}  // namespace
}  // namespace scumble
