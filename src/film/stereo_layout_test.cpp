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

TEST(StereoLayout, anaglyphsAreRedAtLeftAndCyanAtRight) {
  const Image left{2, 1, {"R", "G", "B", "A"}, {1, 2, 3, 0.25f, 4, 5, 6, 1}};
  const Image right{2, 1, {"R", "G", "B", "A"}, {7, 8, 9, 0.5f, 10, 11, 12, 0}};
  EXPECT_EQ(anaglyph(left, right).pixels, (std::vector<float>{1, 8, 9, 0.5f, 4, 11, 12, 1}));
  EXPECT_EQ(anaglyph(left, left).pixels, left.pixels);
  Image codes{1, 1, {"R", "G", "B", "A"}, {}};
  codes.format = PixelFormat::srgb8, codes.codes = {10, 20, 30, 255};
  Image others = codes;
  others.codes = {40, 50, 60, 0};
  EXPECT_EQ(anaglyph(codes, others).codes, (std::vector<uint8_t>{10, 50, 60, 255}));
  // What is of another kind counts as nothing.
  EXPECT_EQ(anaglyph(left, codes).pixels, (std::vector<float>{1, 0, 0, 0.25f, 4, 0, 0, 1}));
  EXPECT_EQ(anaglyph(left, kRight).pixels, (std::vector<float>{1, 0, 0, 0.25f, 4, 0, 0, 1}));
}

TEST(StereoLayout, rowsOfDifferentPicturesStayApart) {
  const Image tall{1, 2, {"R"}, {1, 2}}, wide{2, 1, {"R"}, {3, 4}};
  EXPECT_EQ(sideBySide(tall, wide).pixels, (std::vector<float>{1, 3, 4, 2, 0, 0}));
  EXPECT_EQ(overUnder(tall, wide).pixels, (std::vector<float>{1, 0, 2, 0, 3, 4}));
}

}  // namespace
}  // namespace scumble
