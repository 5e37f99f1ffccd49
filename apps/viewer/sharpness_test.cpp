#include "sharpness.h"

#include <gtest/gtest.h>

namespace scumble::viewer {
namespace {

constexpr glm::uvec2 kFull(1280, 720);

TEST(Sharpness, whatIsFastEnoughMovesInFull) {
  Sharpness sharpness;
  EXPECT_EQ(sharpness.sizeWhileMoving(kFull), kFull);  // nothing is known yet
  sharpness.drew(kFull, 30);
  EXPECT_EQ(sharpness.sizeWhileMoving(kFull), kFull);
}

TEST(Sharpness, whatIsSlowMovesInHalvesAndQuarters) {
  Sharpness sharpness;
  sharpness.drew(kFull, 150);
  EXPECT_EQ(sharpness.sizeWhileMoving(kFull), glm::uvec2(640, 360));
  sharpness.drew(kFull, 600);
  EXPECT_EQ(sharpness.sizeWhileMoving(kFull), glm::uvec2(320, 180));
  sharpness.drew(kFull, 1e6);
  EXPECT_EQ(sharpness.sizeWhileMoving(kFull), glm::uvec2(320, 180));
}

TEST(Sharpness, theFirstPictureIsCoarse) {
  EXPECT_EQ(Sharpness::coarsest(kFull), glm::uvec2(320, 180));
  EXPECT_EQ(Sharpness::coarsest({1, 3}), glm::uvec2(1));
}

// Of a small picture much time is the same as of a large one: it must not make the next ones small as well.
TEST(Sharpness, smallPicturesSayNothingAboutLargeOnes) {
  Sharpness sharpness;
  sharpness.drew(kFull, 30);
  sharpness.drew({320, 180}, 25);
  EXPECT_EQ(sharpness.sizeWhileMoving(kFull), kFull);
}

TEST(Sharpness, restsAWhileAfterTheLastMotion) {
  Sharpness sharpness;
  EXPECT_FALSE(sharpness.isMoving(100));
  sharpness.moved(100);
  EXPECT_TRUE(sharpness.isMoving(100.05));
  EXPECT_NEAR(sharpness.untilRest(100.05), Sharpness::kRestSeconds - 0.05, 1e-9);
  EXPECT_FALSE(sharpness.isMoving(100 + 1.001 * Sharpness::kRestSeconds));
}

}  // namespace
}  // namespace scumble::viewer
