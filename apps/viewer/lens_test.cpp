// Pixels and places against each other, with a camera that is turned and rolled.
#include "lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace scumble::viewer {
namespace {

const glm::vec2 kWindow(800, 450);

Lens turned(bool isParallel = false) {
  View view;
  view.worldToEye = glm::rotate(glm::mat4(1), 0.3f, glm::vec3(0, 0, 1)) *
                    glm::lookAt(glm::vec3(4, 3, 6), glm::vec3(0.5f, 1, 0), glm::vec3(0, 1, 0));
  view.eyeToClip = isParallel ? orthographicProjection(3, kWindow.x / kWindow.y, 0.1f, 50)
                              : perspectiveProjection(0.7f, kWindow.x / kWindow.y, 0.01f);
  return {view, kWindow};
}

void expectPlace(const glm::vec3& actual, const glm::vec3& expected, float within) {
  EXPECT_LT(glm::distance(actual, expected), within) << actual.x << " " << actual.y << " " << actual.z;
}

TEST(VisibleLens, whatIsLookedAtIsInTheMiddle) {
  const auto pixel = turned().pixelOf({0.5f, 1, 0});
  ASSERT_TRUE(pixel);
  EXPECT_LT(glm::distance(*pixel, 0.5f * kWindow), 1e-2f);
  EXPECT_FALSE(turned().pixelOf({8, 6, 12})) << "behind the viewer";
}

TEST(VisibleLens, raysGoThroughThePixelsOfPlaces) {
  for (const bool isParallel : {false, true})
    for (const glm::vec3 place : {glm::vec3(0), glm::vec3(1, 0.5f, -2), glm::vec3(-1, 2, 1)}) {
      const Lens lens = turned(isParallel);
      const Lens::Ray ray = lens.rayAt(*lens.pixelOf(place));
      EXPECT_NEAR(glm::length(ray.way), 1, 1e-5f);
      const glm::vec3 apart = place - ray.from;
      EXPECT_LT(glm::length(apart - ray.way * glm::dot(apart, ray.way)), 1e-3f);
      EXPECT_GT(glm::dot(apart, ray.way), 0);
    }
}

// A near plane close to the eye, far from the world's origin.
TEST(VisibleLens, raysAreExactWhereverOneStands) {
  View view;
  const glm::vec3 eye(104, -30, 60), target(100, -31, 55);
  view.worldToEye = glm::lookAt(eye, target, glm::vec3(0, 1, 0));
  view.eyeToClip = perspectiveProjection(0.7f, kWindow.x / kWindow.y, 1e-4f);
  const Lens lens(view, kWindow);
  for (const glm::vec2 mouse : {glm::vec2(400, 225), glm::vec2(10, 440), glm::vec2(700, 30)})
    EXPECT_LT(glm::distance(*lens.pixelOf(lens.draggedFreely(target, mouse)), mouse), 0.1f);
}

TEST(VisibleLens, aPixelIsAsWideAsItLooks) {
  const Lens lens = turned();
  const glm::vec3 place(0.5f, 1, 0);
  const float size = lens.pixelSize(place);
  EXPECT_NEAR(glm::distance(*lens.pixelOf(place), *lens.pixelOf(place + 10 * size * lens.right())), 10,
              0.05f);
}

TEST(VisibleLens, whatIsDraggedIsUnderTheMouse) {
  const glm::vec2 mouse(300, 260);
  const glm::vec3 place(0.4f, 0.6f, 0.3f), axis = glm::normalize(glm::vec3(1, 2, -1));
  for (const bool isParallel : {false, true}) {
    const Lens lens = turned(isParallel);
    const glm::vec3 freely = lens.draggedFreely(place, mouse);
    EXPECT_LT(glm::distance(*lens.pixelOf(freely), mouse), 0.05f);
    const std::optional<glm::vec3> level = lens.draggedLevel(place, mouse);
    ASSERT_TRUE(level);
    EXPECT_LT(glm::distance(*lens.pixelOf(*level), mouse), 0.05f);
    EXPECT_NEAR(level->y, place.y, 1e-4f);
    // Along an axis: where that passes nearest to the mouse, which is on it.
    const std::optional<glm::vec3> along = lens.draggedAlong(place, axis, *lens.pixelOf(place + 0.7f * axis));
    ASSERT_TRUE(along);
    expectPlace(*along, place + 0.7f * axis, 2e-3f);
    // What is not moved stays.
    expectPlace(lens.draggedFreely(place, *lens.pixelOf(place)), place, 1e-3f);
  }
  EXPECT_FALSE(turned().draggedAlong(place, turned().rayAt(mouse).way, mouse)) << "one looks along it";
  EXPECT_FALSE(turned().draggedLevel(place, {400, -4000})) << "the sky";
}

TEST(VisibleLens, directionsLieOnADisc) {
  const Lens lens = turned();
  const glm::vec3 towards = -lens.rayAt(0.5f * kWindow).way;
  EXPECT_LT(glm::length(lens.discOf(towards)), 1e-3f);
  EXPECT_NEAR(glm::length(lens.discOf(-towards)), 2, 1e-3f);
  EXPECT_LT(glm::distance(lens.discOf(lens.right()), {1, 0}), 1e-3f);
  // What lies higher in the picture lies higher on the disc.
  const glm::vec3 place(0.5f, 1, 0), above = lens.draggedFreely(place, 0.5f * kWindow - glm::vec2(0, 50));
  EXPECT_LT(glm::distance(lens.discOf(glm::normalize(above - place)), {0, -1}), 1e-2f);
  for (const glm::vec2 disc :
       {glm::vec2(0), glm::vec2(0.3f, -0.5f), glm::vec2(-1.2f, 0.9f), glm::vec2(0, 1.99f)}) {
    EXPECT_NEAR(glm::length(lens.directionAt(disc)), 1, 1e-5f);
    EXPECT_LT(glm::distance(lens.discOf(lens.directionAt(disc)), disc), 2e-3f);
  }
  expectPlace(lens.directionAt({30, 0}), -towards, 1e-3f);
}

}  // namespace
}  // namespace scumble::viewer
