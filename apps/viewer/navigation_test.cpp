#include "navigation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "camera.h"

namespace scumble::viewer {
namespace {

// From (0, 0, 5) along -z.
View viewFrom(float roll = 0, float field = 34) {
  View view;
  view.worldToEye =
      glm::rotate(glm::mat4(1), glm::radians(roll), {0, 0, 1}) * glm::translate(glm::mat4(1), {0, 0, -5});
  view.eyeToClip = perspectiveProjection(glm::radians(field), 1.5f, 0.1f);
  return view;
}

Navigation started(float roll = 0, float field = 34) {
  Navigation navigation;
  navigation.takeUp(viewFrom(roll, field), {0.3f, 0.1f, 0}, 1);
  return navigation;
}

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-4f) {
  EXPECT_NEAR(glm::distance(a, b), 0, tolerance)
      << a.x << ", " << a.y << ", " << a.z << " and " << b.x << ", " << b.y << ", " << b.z;
}

TEST(Navigation, takesUpWhereAViewSees) {
  const Viewpoint seen = started(20, 50).viewpoint();
  expectNear(*seen.eye, {0, 0, 5});
  expectNear(*seen.target, {0, 0, 0});  // in the middle, as far as the centre
  EXPECT_NEAR(*seen.roll, 20, 1e-3f);
  EXPECT_NEAR(*seen.verticalFov, 50, 1e-3f);
}

// A million metres out, where hands move it as they do here.
TEST(Navigation, takesUpViewsFarOut) {
  const glm::dvec3 far(1e6, -2e5, 4e6);
  View view = viewFrom();
  view.origin = far;
  Navigation navigation, near;
  navigation.takeUp(view, far + glm::dvec3(0.25, 0, 0), 1), near.takeUp(viewFrom(), {0.25, 0, 0}, 1);
  for (Navigation* const each : {&navigation, &near}) each->orbit({0.1f, 0.05f}), each->pan({0.01f, 0.02f});
  EXPECT_LT(glm::distance(*navigation.viewpoint().eye - far, *near.viewpoint().eye), 1e-8);
  EXPECT_LT(glm::distance(*navigation.viewpoint().target - far, *near.viewpoint().target), 1e-8);
}

TEST(Navigation, takesUpParallelProjectionsAsWhatTheyShow) {
  View view = viewFrom();
  view.eyeToClip = orthographicProjection(1, 1.5f, 0.1f, 100);
  Navigation navigation;
  navigation.takeUp(view, {0, 0, 0}, 1);
  EXPECT_NEAR(*navigation.viewpoint().verticalFov, glm::degrees(2 * std::atan(1 / 5.0f)), 1e-3f);
}

TEST(Navigation, takesUpViewsThatLookAwayFromTheScene) {
  Navigation navigation;
  navigation.takeUp(viewFrom(), {0, 0, 50}, 2);
  expectNear(*navigation.viewpoint().target, {0, 0, 3});
}

TEST(Navigation, orbitsAroundWhatItLooksAt) {
  Navigation navigation = started();
  navigation.orbit({0.1f, 0});
  const Viewpoint seen = navigation.viewpoint();
  expectNear(*seen.target, {0, 0, 0});
  EXPECT_NEAR(glm::length(*seen.eye), 5, 1e-4f);
  EXPECT_LT(seen.eye->x, -1);  // what was dragged to the right has turned to the right
  EXPECT_NEAR(seen.eye->y, 0, 1e-4f);
  navigation.orbit({-0.1f, 0});
  expectNear(*navigation.viewpoint().eye, {0, 0, 5});
}

TEST(Navigation, neverTurnsOverThePole) {
  Navigation navigation = started();
  for (int i = 0; i < 20; ++i) navigation.orbit({0, 0.2f});
  const glm::vec3 eye = *navigation.viewpoint().eye;
  EXPECT_GT(eye.y, 4.99f);
  EXPECT_LT(eye.y / 5, 0.999f);  // where makeViews takes another direction for up
  EXPECT_GT(eye.z, 0);
  navigation.orbit({0, -0.2f});
  EXPECT_LT(navigation.viewpoint().eye->y, 4.9f);
}

// A point in the middle follows the hand over the whole height of the window.
TEST(Navigation, panMovesWhatIsSeenWithTheHand) {
  for (const float roll : {0.0f, 90.0f}) {
    Navigation navigation = started(roll);
    navigation.pan({0.25f, -0.5f});
    const Viewpoint seen = navigation.viewpoint();
    const float height = 10 * std::tan(glm::radians(17.0f));
    const glm::vec3 moved(-0.25f * height, -0.5f * height, 0);
    const glm::vec3 expected = roll == 0 ? moved : glm::vec3(moved.y, -moved.x, 0);
    expectNear(*seen.target, expected);
    expectNear(*seen.eye, expected + glm::vec3(0, 0, 5));
  }
}

TEST(Navigation, zoomsTowardsWhatItLooksAtAndNeverThrough) {
  Navigation navigation = started();
  navigation.zoom(1);
  EXPECT_NEAR(navigation.distance(), 5 * 6 / 7.0f, 1e-4f);
  navigation.zoom(-1);
  EXPECT_NEAR(navigation.distance(), 5, 1e-4f);
  navigation.zoom(1e6f);
  EXPECT_GT(navigation.distance(), 0);
  navigation.zoom(-1e6f);
  EXPECT_TRUE(std::isfinite(navigation.distance()));
}

TEST(Navigation, looksAroundFromWhereItStands) {
  Navigation navigation = started();
  navigation.lookAround({0.5f, 0});
  const Viewpoint seen = navigation.viewpoint();
  expectNear(*seen.eye, {0, 0, 5});
  const float turned = glm::radians(17.0f);
  expectNear(*seen.target, {5 * std::sin(turned), 0, 5 - 5 * std::cos(turned)});
}

TEST(Navigation, fliesAlongItsAxes) {
  Navigation navigation = started();
  navigation.fly({0, 0, 0.5f});
  expectNear(*navigation.viewpoint().eye, {0, 0, 2.5f});
  expectNear(*navigation.viewpoint().target, {0, 0, -2.5f});
  navigation.fly({0.2f, 0, 0});
  expectNear(*navigation.viewpoint().eye, {1, 0, 2.5f});
}

TEST(Navigation, looksFromSidesAsOrbitsDo) {
  Navigation navigation = started(30);
  navigation.lookFrom(90, 0);
  expectNear(*navigation.viewpoint().eye, {5, 0, 0});
  EXPECT_EQ(*navigation.viewpoint().roll, 0);
  navigation.lookFrom(0, 90);
  EXPECT_GT(navigation.viewpoint().eye->y, 4.99f);
}

TEST(Navigation, rollAndFieldStayInTheirRanges) {
  Navigation navigation = started();
  for (int i = 0; i < 100; ++i) navigation.roll(50), navigation.widen(2);
  EXPECT_LE(std::abs(*navigation.viewpoint().roll), 180);
  EXPECT_EQ(*navigation.viewpoint().verticalFov, 150);
}

TEST(Cameras, areTheFirstAnotherOrHeld) {
  Viewpoint first, other;
  first.orbit = other.orbit = true;
  first.azimuth = 10, other.azimuth = 20;
  Camera camera(first);
  EXPECT_EQ(camera.viewpoint().azimuth, 10);
  EXPECT_FALSE(camera.isOther());
  camera.set(other);
  EXPECT_EQ(camera.viewpoint().azimuth, 20);
  EXPECT_TRUE(camera.isOther());
  const uint64_t moves = camera.moves();
  camera.hold(std::nullopt).orbit({0.1f, 0});
  EXPECT_FALSE(camera.isHeld()) << "it is not known from where it is seen";
  View view;
  view.worldToEye = glm::translate(glm::mat4(1), glm::vec3(0, 0, -5));
  view.eyeToClip = perspectiveProjection(0.6f, 1, 0.1f);
  camera.hold(view).orbit({0.1f, 0});
  EXPECT_TRUE(camera.isHeld());
  EXPECT_TRUE(camera.viewpoint().eye);
  EXPECT_GT(camera.moves(), moves);
  camera.set(std::nullopt);
  EXPECT_EQ(camera.viewpoint().azimuth, 10);
  EXPECT_FALSE(camera.isOther());
}

}  // namespace
}  // namespace scumble::viewer
