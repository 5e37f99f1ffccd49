// Views that hang on what moves.
#include "renderer/view_groups.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace scumble::renderer {
namespace {

constexpr float kIpd = 0.064f;

// Two eyes at a place, with a heading in degrees and a head that looks down a little.
std::vector<View> eyesAt(const glm::vec3& place, float heading) {
  glm::mat4 head = glm::translate(glm::mat4(1), place);
  head = glm::rotate(head, glm::radians(heading), {0, 1, 0});
  head = glm::rotate(head, glm::radians(-10.0f), {1, 0, 0});
  std::vector<View> eyes(2);
  for (int eye = 0; eye < 2; ++eye)
    eyes[size_t(eye)].worldToEye =
        glm::inverse(glm::translate(head, {eye == 0 ? -kIpd / 2 : kIpd / 2, 0, 0}));
  for (View& eye : eyes) eye.eyeToClip = perspectiveProjection(1, 1, 0.1f), eye.node = 3;
  return eyes;
}

// A boat about its own middle: heave, yaw, pitch and roll.
glm::mat4 boat(float yaw, float pitch, float roll) {
  glm::mat4 moved = glm::translate(glm::mat4(1), {4, 1.5f, -2});
  moved = glm::rotate(moved, glm::radians(yaw), {0, 1, 0});
  moved = glm::rotate(moved, glm::radians(pitch), {1, 0, 0});
  moved = glm::rotate(moved, glm::radians(roll), {0, 0, 1});
  return glm::translate(moved, {-4, 0, 2});
}

std::vector<View> carriedOn(const glm::mat4& moved, std::vector<View> views) {
  return carriedBy(
      [&](int node) {
        EXPECT_EQ(node, 3);
        return moved;
      },
      std::move(views));
}

TEST(ViewsOnNodes, goAllTheWay) {
  const std::vector<View> eyes = eyesAt({5, 2, 1}, 40);
  const glm::mat4 moved = boat(20, 8, -12);
  const std::vector<View> gone = carriedOn(moved, eyes);
  for (size_t eye = 0; eye < 2; ++eye) {
    const glm::mat4 wanted = moved * glm::inverse(eyes[eye].worldToEye),
                    found = glm::inverse(gone[eye].worldToEye);
    for (int i = 0; i < 16; ++i) EXPECT_NEAR(found[i / 4][i % 4], wanted[i / 4][i % 4], 1e-5f);
  }
  // Those that hang on nothing stay, to the bit.
  std::vector<View> free = eyes;
  for (View& view : free) view.node = -1;
  EXPECT_EQ(carriedOn(moved, free)[1].worldToEye, free[1].worldToEye);
}

TEST(ViewsOnNodes, levelOnesKeepTheHorizonAndTheirDistance) {
  std::vector<View> eyes = eyesAt({5, 2, 1}, 40);
  for (View& eye : eyes) eye.isLevel = true;
  for (const float yaw : {0.0f, 35.0f, -170.0f})
    for (const float tilt : {0.0f, 9.0f, -20.0f}) {
      const glm::mat4 moved = boat(yaw, tilt, 0.7f * tilt);
      const std::vector<View> gone = carriedOn(moved, eyes);
      const glm::mat4 left = glm::inverse(gone[0].worldToEye), right = glm::inverse(gone[1].worldToEye);
      const glm::vec3 across(right[3] - left[3]);
      EXPECT_NEAR(glm::length(across), kIpd, 1e-5f);
      EXPECT_NEAR(across.y, 0, 1e-5f) << "one eye is higher than the other";
      const glm::vec3 middle = 0.5f * glm::vec3(left[3] + right[3]);
      const glm::vec3 wanted = moved * glm::vec4(5, 2, 1, 1);
      EXPECT_LT(glm::distance(middle, wanted), 1e-4f) << "not where the boat takes them";
      // A head that looks down ten degrees still does.
      for (const glm::mat4& eye : {left, right}) {
        EXPECT_NEAR(eye[0].y, 0, 1e-5f) << "rolled";
        EXPECT_NEAR(-eye[2].y, std::sin(glm::radians(-10.0f)), 1e-5f) << "pitched";
      }
      if (tilt == 0) {
        const float heading = glm::degrees(std::atan2(left[2].x, left[2].z));
        EXPECT_NEAR(std::remainder(heading - 40 - yaw, 360.0f), 0, 1e-3f);
      }
    }
}

}  // namespace
}  // namespace scumble::renderer
