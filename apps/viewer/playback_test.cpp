#include "playback.h"

#include <gtest/gtest.h>

namespace scumble::viewer {
namespace {

TEST(Playback, showsPicturesOfAFilmWhileItPlays) {
  Playback playback{.playhead = 1.03, .duration = 8};
  EXPECT_EQ(playback.pictureTime(), 1.03);
  playback.toggle();
  EXPECT_DOUBLE_EQ(playback.pictureTime(), 1);
  playback.playhead = 1.05;
  EXPECT_DOUBLE_EQ(playback.pictureTime(), 25 / 24.0);
  playback.onTwos = true;
  EXPECT_DOUBLE_EQ(playback.pictureTime(), 1);
  playback.toggle();
  EXPECT_DOUBLE_EQ(playback.playhead, 1);  // it stays at what was seen
}

TEST(Playback, stepsToTheNextPictureAndBack) {
  Playback playback{.playhead = 1.03, .duration = 8, .isPlaying = true};
  for (int i = 1; i <= 1000; ++i) {
    playback.step(1);
    ASSERT_DOUBLE_EQ(playback.pictureTime(), (24 + i) / 24.0);
  }
  EXPECT_FALSE(playback.isPlaying);
  playback.step(-1000);
  EXPECT_DOUBLE_EQ(playback.pictureTime(), 1);
  playback.step(-1000);
  EXPECT_EQ(playback.pictureTime(), 0);
}

TEST(Playback, playsAroundAtItsSpeed) {
  Playback playback{.duration = 2, .isPlaying = true};
  playback.advance(1.5);
  EXPECT_DOUBLE_EQ(playback.playhead, 1.5);
  playback.goFaster(2);
  playback.advance(0.5);
  EXPECT_DOUBLE_EQ(playback.playhead, 0.5);
  for (int i = 0; i < 20; ++i) playback.goFaster(2);
  EXPECT_EQ(playback.speed, 16);
  playback.duration = 0;
  EXPECT_FALSE(playback.moves());
  playback.advance(1);
  EXPECT_DOUBLE_EQ(playback.playhead, 0.5);
}

}  // namespace
}  // namespace scumble::viewer
