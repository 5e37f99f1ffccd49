#include "stereo_layout.h"

#include <gtest/gtest.h>

namespace scumble::app {
namespace {

TEST(StereoLayouts, eyesTakeTurnsOfAnEighthOfASecond) {
  struct {
    double fps;
    int frames;
  } const turns[] = {{24, 3}, {25, 3}, {30, 4}, {60, 8}, {8, 1}, {4, 1}, {1, 1}, {23.976, 3}};
  for (const auto& [fps, frames] : turns) {
    EXPECT_EQ(framesInTurn(fps), frames) << fps;
    // Whole turns, from frame 0 on and before it as well.
    for (int frame = -3 * frames; frame < 3 * frames; ++frame) {
      const int turn = (frame + 4 * frames) / frames;
      EXPECT_EQ(eyeInTurn(frame, fps), size_t(turn % 2)) << fps << ", frame " << frame;
    }
  }
}

TEST(StereoLayouts, areFoundByName) {
  ASSERT_TRUE(stereoLayoutOf(""));
  EXPECT_EQ(*stereoLayoutOf(""), nullptr);
  for (const char* name : {"side-by-side", "over-under", "crossed", "anaglyph", "wiggle", "separate"}) {
    const auto layout = stereoLayoutOf(name);
    ASSERT_TRUE(layout) << name;
    EXPECT_STREQ((*layout)->name, name);
    EXPECT_NE(stereoLayoutNames().find(name), std::string::npos);
    // One picture of two eyes, one picture an eye, or a file for each: one of them.
    EXPECT_EQ(int((*layout)->arrange != nullptr) + int((*layout)->isInTurns) + int((*layout)->isSeparate), 1)
        << name;
  }
  const auto wrong = stereoLayoutOf("over_under");
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().kind, ErrorKind::usage);
  EXPECT_NE(wrong.error().message().find("over-under"), std::string::npos) << wrong.error().message();
}

// Which eye is where: the left one's picture is of 1, the right one's of 2.
TEST(StereoLayouts, eyesLieWhereTheirNameSays) {
  const auto picture = [](float value) {
    Image image;
    image.width = 2, image.height = 2;
    image.channels = {"R", "G", "B"};
    image.pixels.assign(12, value);
    return image;
  };
  const auto eyeAt = [&](const char* name, bool isFact, bool isLater) {
    const StereoLayout& layout = **stereoLayoutOf(name);
    const Image both = (isFact ? layout.arrangeFacts : layout.arrange)(picture(1), picture(2));
    EXPECT_EQ(both.width, 2 * layout.across) << name;
    EXPECT_EQ(both.height, 2 * layout.down) << name;
    return both.at(isLater && layout.across > 1 ? 3 : 0, isLater && layout.down > 1 ? 3 : 0, 0);
  };
  for (const bool isFact : {false, true}) {
    EXPECT_EQ(eyeAt("side-by-side", isFact, false), 1);
    EXPECT_EQ(eyeAt("side-by-side", isFact, true), 2);
    EXPECT_EQ(eyeAt("over-under", isFact, false), 1);
    EXPECT_EQ(eyeAt("over-under", isFact, true), 2);
    EXPECT_EQ(eyeAt("crossed", isFact, false), 2);
    EXPECT_EQ(eyeAt("crossed", isFact, true), 1);
  }
  // Facts have no colours that glasses tell apart.
  const Image facts = (*stereoLayoutOf("anaglyph"))->arrangeFacts(picture(1), picture(2));
  EXPECT_EQ(facts.width, 4u);
}

}  // namespace
}  // namespace scumble::app
