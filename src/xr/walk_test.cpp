// What sticks do to whoever stands in a scene.
#include "xr/walk.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scumble::xr {
namespace {

const Stand kStand{{10, 2, -5}, 0.4f, 1};
const XrFovf kAngles{-0.8f, 0.8f, 0.8f, -0.8f};

glm::mat4 headIn(const Walk& walk, const Stand& stand, const Pose& head) {
  return glm::inverse(viewOf(walk.on(stand), head, kAngles, 0.1f).worldToEye);
}

Pose headAt(const glm::vec3& place, float degrees) {
  return {aboutVertical(glm::radians(degrees)), place};
}

TEST(WalksInScenes, goWhereTheHeadLooks) {
  for (const float scale : {1.0f, 12.0f})
    for (const float looking : {0.0f, 70.0f, 200.0f}) {
      const Stand stand{kStand.place, kStand.heading, scale};
      const Pose head = headAt({0.3f, 1.5f, -0.2f}, looking);
      Walk walk;
      const glm::mat4 before = headIn(walk, stand, head);
      for (int i = 0; i < 90; ++i) walk.go(stand, head, {{0, 1}, 0}, 1.0f / 90);
      const glm::vec3 gone(headIn(walk, stand, head)[3] - before[3]);
      const glm::vec3 wanted = -glm::vec3(before[2]) * kWalkSpeed * scale;
      EXPECT_LT(glm::distance(gone, wanted), 1e-3f * scale);
      EXPECT_EQ(walk.motion(), 1);
      // And back, and to the side.
      for (int i = 0; i < 90; ++i) walk.go(stand, head, {{0, -1}, 0}, 1.0f / 90);
      EXPECT_LT(glm::distance(headIn(walk, stand, head)[3], before[3]), 1e-3f * scale);
      for (int i = 0; i < 90; ++i) walk.go(stand, head, {{1, 0}, 0}, 1.0f / 90);
      EXPECT_LT(glm::distance(glm::vec3(headIn(walk, stand, head)[3] - before[3]),
                              glm::vec3(before[0]) * kWalkSpeed * scale),
                1e-3f * scale);
    }
}

TEST(WalksInScenes, areOnTheLevelWhereverTheHeadLooks) {
  for (const float pitch : {60.0f, -60.0f, 90.0f, -90.0f}) {
    const float half = glm::radians(pitch) / 2;
    const Pose head{glm::quat(std::cos(half), std::sin(half), 0, 0), {0, 1.5f, 0}};
    Walk walk;
    const glm::mat4 before = headIn(walk, kStand, head);
    walk.go(kStand, head, {{0, 1}, 0}, 1);
    const glm::vec3 gone(headIn(walk, kStand, head)[3] - before[3]);
    EXPECT_NEAR(gone.y, 0, 1e-6f) << pitch;
    EXPECT_NEAR(glm::length(gone), kWalkSpeed, 1e-4f) << pitch;
    EXPECT_NEAR(
        glm::dot(glm::normalize(gone), -glm::vec3(std::sin(kStand.heading), 0, std::cos(kStand.heading))), 1,
        1e-4f)
        << pitch;
  }
}

TEST(WalksInScenes, sticksAtRestDoNothing) {
  Walk walk;
  for (int i = 0; i < 900; ++i) walk.go(kStand, headAt({0, 1, 0}, 10), {{0.1f, -0.15f}, 0.39f}, 1.0f / 90);
  EXPECT_EQ(walk.on(kStand).place, kStand.place);
  EXPECT_EQ(walk.on(kStand).heading, kStand.heading);
  EXPECT_EQ(walk.motion(), 0);
}

// Once a push, around the head, which stays where it is.
TEST(WalksInScenes, turnByAngles) {
  const Pose head = headAt({1.2f, 1.6f, 0.4f}, 25);
  Walk walk;
  walk.go(kStand, head, {{0.6f, 0.6f}, 0}, 2);
  const glm::mat4 before = headIn(walk, kStand, head);
  const auto turned = [&] {
    const glm::mat4 now = headIn(walk, kStand, head);
    EXPECT_LT(glm::distance(now[3], before[3]), 1e-4f) << "the head has moved";
    const float angle = std::atan2(now[2].x, now[2].z) - std::atan2(before[2].x, before[2].z);
    return std::remainder(glm::degrees(angle), 360.0f);
  };
  for (const float stick : {0.5f, 0.75f, 1.0f, 0.8f, 0.5f, 0.9f})
    walk.go(kStand, head, {{0, 0}, stick}, 0.01f);
  EXPECT_NEAR(turned(), -kTurnAngle, 1e-3f) << "to the right, once";
  for (const float stick : {0.2f, 0.9f}) walk.go(kStand, head, {{0, 0}, stick}, 0.01f);
  EXPECT_NEAR(turned(), -2 * kTurnAngle, 1e-3f);
  for (const float stick : {0.0f, -0.9f, 0.0f, -0.9f, 0.0f, -0.9f})
    walk.go(kStand, head, {{0, 0}, stick}, 0.01f);
  EXPECT_NEAR(turned(), kTurnAngle, 1e-3f);
  walk.reset();
  walk.go(kStand, head, {{0, 0}, -0.9f}, 0.01f);
  EXPECT_EQ(walk.on(kStand).place, kStand.place);
  EXPECT_EQ(walk.on(kStand).heading, kStand.heading);
}

}  // namespace
}  // namespace scumble::xr
