// What views can see: boxes at each border of a view, and nothing of what is seen left out.
#include "stage/visibility.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "scumble/view.h"

namespace scumble::stage {
namespace {

scene::Bounds boxAround(const glm::vec3& center, const glm::vec3& half) {
  scene::Bounds box;
  box.add(center - half);
  box.add(center + half);
  return box;
}

// A parallel view along -Z of 4 x 2 metres, from 1 to 9 metres.
TEST(Visibility, endsAtEachBorderAndItsMargin) {
  const glm::mat4 view = orthographicProjection(1, 2, 1, 9);
  const glm::vec3 half(0.5f, 0.25f, 0.75f), middle(0, 0, -5), reach(2, 1, 4);
  for (const glm::vec2 margin : {glm::vec2(0.0f), glm::vec2(0.1f, 0.3f)})
    for (int axis = 0; axis < 3; ++axis)
      for (const float side : {-1.0f, 1.0f}) {
        glm::vec3 at = middle;
        const float border = reach[axis] * (axis < 2 ? 1 + margin[axis] : 1.0f) + half[axis];
        at[axis] = middle[axis] + side * (border - 0.01f);
        EXPECT_TRUE(mayBeSeen(boxAround(at, half), view, margin)) << "axis " << axis << ", side " << side;
        at[axis] = middle[axis] + side * (border + 0.01f);
        EXPECT_FALSE(mayBeSeen(boxAround(at, half), view, margin)) << "axis " << axis << ", side " << side;
      }
  EXPECT_FALSE(mayBeSeen(scene::Bounds(), view, {}));
}

// Points of boxes that a perspective shows; and nothing behind the eye is drawn.
TEST(Visibility, leavesOutNothingThatIsSeen) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> number(-1, 1);
  const auto vector = [&] { return glm::vec3(number(random), number(random), number(random)); };
  size_t seen = 0, leftOut = 0;
  for (int tries = 0; tries < 3000; ++tries) {
    const glm::mat4 clip =
        perspectiveProjection(0.4f + 0.3f * number(random), 1.6f, 0.1f) *
        glm::lookAt(3.0f * vector(), 3.0f * vector(), glm::normalize(vector() + glm::vec3(0, 2, 0)));
    const scene::Bounds box = boxAround(5.0f * vector(), glm::abs(vector()));
    const glm::vec2 margin = 0.2f * glm::abs(glm::vec2(vector()));
    bool isSeen = false;
    for (int i = 0; i < 60 && !isSeen; ++i) {
      const glm::dvec3 share = 0.5 + 0.5 * glm::dvec3(vector());
      const glm::dvec4 p =
          glm::dmat4(clip) * glm::dvec4(glm::mix(glm::dvec3(box.min), glm::dvec3(box.max), share), 1);
      isSeen = std::abs(p.x) < (1 + margin.x) * p.w && std::abs(p.y) < (1 + margin.y) * p.w && p.z > 0 &&
               p.z < p.w;
    }
    const bool may = mayBeSeen(box, clip, margin);
    EXPECT_TRUE(may || !isSeen);
    seen += isSeen, leftOut += !may;
  }
  EXPECT_GT(seen, 300u);
  EXPECT_GT(leftOut, 1000u);
  const glm::mat4 clip = perspectiveProjection(1, 1, 0.1f);
  EXPECT_TRUE(mayBeSeen(boxAround({0, 0, -2}, glm::vec3(0.5f)), clip, {}));
  EXPECT_FALSE(mayBeSeen(boxAround({0, 0, 2}, glm::vec3(0.5f)), clip, {}));
}

}  // namespace
}  // namespace scumble::stage
