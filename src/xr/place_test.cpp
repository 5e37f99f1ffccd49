// Poses and angles against the views that the library makes of the same.
#include "xr/place.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/loaded_test_gltf.h"

namespace scumble::xr {
namespace {

void expectAlike(const glm::mat4& a, const glm::mat4& b, float within = 1e-5f) {
  for (int i = 0; i < 16; ++i) EXPECT_NEAR(a[i / 4][i % 4], b[i / 4][i % 4], within) << i;
}

TEST(PlaceOfHeads, symmetricAnglesAreAPerspective) {
  const float half = 0.6f, aspect = 1.25f, across = std::atan(std::tan(half) * aspect);
  expectAlike(projectionOf({-across, across, half, -half}, 0.1f),
              perspectiveProjection(2 * half, aspect, 0.1f));
}

// Corners of what is seen lie in the corners of the picture, also where the eye looks out of its middle.
TEST(PlaceOfHeads, anglesAreTheEdgesOfThePicture) {
  const XrFovf angles{-0.9f, 0.6f, 0.7f, -0.8f};
  const glm::mat4 p = projectionOf(angles, 0.05f);
  const auto seen = [&](float x, float y, float distance) {
    const glm::vec4 clip = p * glm::vec4(std::tan(x) * distance, std::tan(y) * distance, -distance, 1);
    return glm::vec3(clip) / clip.w;
  };
  for (const float distance : {0.05f, 1.0f, 300.0f}) {
    const glm::vec3 low = seen(angles.angleLeft, angles.angleUp, distance),
                    high = seen(angles.angleRight, angles.angleDown, distance);
    EXPECT_NEAR(low.x, -1, 1e-5f);
    EXPECT_NEAR(low.y, -1, 1e-5f) << "y is down";
    EXPECT_NEAR(high.x, 1, 1e-5f);
    EXPECT_NEAR(high.y, 1, 1e-5f);
    EXPECT_NEAR(low.z, 0.05f / distance, 1e-6f) << "1 at the near plane, 0 far away";
  }
}

// Eyes that look straight ahead from a camera are what makeViews gives for it.
TEST(PlaceOfHeads, aHeadAtACameraSeesWhatTheCameraDoes) {
  const Scene scene = loaded(scene::quad());
  Viewpoint viewpoint;
  viewpoint.eye = {3, 1.5f, -2}, viewpoint.target = {-1, 1.5f, 4}, viewpoint.verticalFov = 50;
  const float ipd = 0.064f;
  const auto wanted = makeViews(scene, viewpoint, 1, Stereo::stereo, ipd);
  auto camera = makeViews(scene, viewpoint, 1);
  ASSERT_TRUE(wanted.ok() && camera.ok());
  // Far out, a room has the camera's origin.
  camera->front().origin = {4e6, -2e5, 5e6};
  for (const float scale : {1.0f, 20.0f})
    for (const float eyeHeight : {0.0f, 1.6f}) {
      const Stand stand = standAt(camera->front(), scale, eyeHeight);
      for (int eye = 0; eye < 2; ++eye) {
        const float side = (eye == 0 ? -0.5f : 0.5f) * ipd / scale;
        const View view =
            viewOf(stand, {{1, 0, 0, 0}, {side, eyeHeight, 0}}, {-0.5f, 0.5f, 0.5f, -0.5f}, 0.05f);
        expectAlike(view.worldToEye, (*wanted)[size_t(eye)].worldToEye, 1e-4f);
        EXPECT_EQ(view.origin, camera->front().origin);
      }
    }
}

TEST(PlaceOfHeads, whatRuntimesTellNeedNotMakeSense) {
  const XrFovf angles{-0.8f, 0.7f, 0.9f, -0.6f};
  EXPECT_TRUE(canBeSeenFrom({}, angles));
  EXPECT_TRUE(canBeSeenFrom({{0.6f, 0, 0.8f, 0}, {3, -2, 900}}, angles));
  for (const XrPosef& pose : {XrPosef{{0, 0, 0, 0}, {0, 0, 0}}, XrPosef{{0, 0, 0, 1}, {0, NAN, 0}},
                              XrPosef{{0, 0, 0, 1}, {INFINITY, 0, 0}}, XrPosef{{NAN, 0, 0, 1}, {0, 0, 0}}})
    EXPECT_FALSE(canBeSeenFrom(poseOf(pose), angles));
  for (const XrFovf& wrong :
       {XrFovf{0, 0, 0, 0}, XrFovf{-0.8f, 0.7f, -0.6f, 0.9f}, XrFovf{0.7f, -0.8f, 0.9f, -0.6f},
        XrFovf{-0.8f, 1.6f, 0.9f, -0.6f}, XrFovf{-0.8f, NAN, 0.9f, -0.6f}})
    EXPECT_FALSE(canBeSeenFrom({}, wrong));
}

TEST(PlaceOfHeads, posesGoBackAsTheyCame) {
  const XrPosef pose{{0.1f, -0.2f, 0.3f, 0.927362f}, {1, -2, 3}};
  const XrPosef back = xrOf(poseOf(pose));
  EXPECT_NEAR(back.orientation.x, 0.1f, 1e-6f);
  EXPECT_NEAR(back.orientation.y, -0.2f, 1e-6f);
  EXPECT_NEAR(back.orientation.z, 0.3f, 1e-6f);
  EXPECT_NEAR(back.orientation.w, 0.927362f, 1e-6f);
  EXPECT_EQ(back.position.x, 1);
  EXPECT_EQ(back.position.y, -2);
  EXPECT_EQ(back.position.z, 3);
  // Of a pose that turns about y, what is ahead goes to the left.
  const glm::vec3 ahead = poseOf({{0, 0.70710678f, 0, 0.70710678f}, {}}).turn * glm::vec3(0, 0, -1);
  EXPECT_NEAR(ahead.x, -1, 1e-6f);
}

// The horizon is where it is, whatever the camera does.
TEST(PlaceOfHeads, standsAreLevel) {
  const Scene scene = loaded(scene::quad());
  for (const glm::vec3& target : {glm::vec3(1, 9, 1), glm::vec3(2, -7, -3), glm::vec3(0.5f, 0, 0.5f)}) {
    Viewpoint viewpoint;
    viewpoint.eye = {0, 2, 0}, viewpoint.target = target, viewpoint.roll = 30.0f;
    const auto camera = makeViews(scene, viewpoint, 1);
    ASSERT_TRUE(camera.ok());
    const Stand stand = standAt(camera->front(), 1, 0);
    const glm::mat4 head = viewOf(stand, {}, {-1, 1, 1, -1}, 0.1f).worldToEye;
    const glm::vec3 ahead = -glm::vec3(glm::inverse(head)[2]);
    EXPECT_NEAR(ahead.y, 0, 1e-6f);
    const glm::vec2 wanted = glm::normalize(glm::vec2(target.x, target.z));
    EXPECT_NEAR(ahead.x, wanted.x, 1e-3f);
    EXPECT_NEAR(ahead.z, wanted.y, 1e-3f);
    EXPECT_NEAR(glm::inverse(head)[1].y, 1, 1e-6f);
  }
}

// Of a camera that looks straight down, what is up in its picture is ahead.
TEST(PlaceOfHeads, aCameraThatLooksDownHasAHeading) {
  View camera;
  camera.worldToEye = glm::lookAt(glm::vec3(0, 5, 0), glm::vec3(0), glm::vec3(1, 0, 0));
  EXPECT_NEAR(standAt(camera, 1, 0).heading, -glm::half_pi<float>(), 1e-5f) << "towards +x";
  camera.worldToEye = glm::lookAt(glm::vec3(0, 5, 0), glm::vec3(0, 9, 0), glm::vec3(-1, 0, 0));
  EXPECT_NEAR(standAt(camera, 1, 0).heading, -glm::half_pi<float>(), 1e-5f);
}

// Between a room and the scene, and between a room and another one.
TEST(PlaceOfHeads, roomsAreSeenFromRooms) {
  const Stand before{{10, 2, -5}, 0.4f, 4}, now{{12, 2, -1}, 1.1f, 4};
  const Pose hand{glm::normalize(glm::quat(0.8f, 0.1f, -0.5f, 0.2f)), {0.3f, 1, -0.2f}};
  const Pose there = inScene(now, hand), back = inRoom(now, there);
  EXPECT_LT(glm::distance(back.place, hand.place), 1e-5f);
  EXPECT_GT(std::abs(glm::dot(back.turn, hand.turn)), 1 - 1e-6f);
  EXPECT_LT(glm::distance(glm::vec3(glm::inverse(viewOf(now, hand, {-1, 1, 1, -1}, 0.1f).worldToEye)[3]),
                          there.place),
            1e-4f);
  // What stands still in the room goes along with it: its place in the room before is the room's there, and
  // its own in that.
  const Pose room = seenFrom(before, now), wanted = inRoom(before, there);
  EXPECT_LT(glm::distance(room.place + room.turn * hand.place, wanted.place), 1e-5f);
  EXPECT_GT(std::abs(glm::dot(room.turn * hand.turn, wanted.turn)), 1 - 1e-6f);
  EXPECT_EQ(seenFrom(now, now).place, glm::vec3(0));
}

}  // namespace
}  // namespace scumble::xr
