#include "stage/view_check.h"

#include <gtest/gtest.h>

#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace scumble::stage {
namespace {

View goodView() {
  View view;
  view.worldToEye = glm::lookAt(glm::vec3(3, 2, 5), glm::vec3(0), glm::vec3(0, 1, 0));
  view.eyeToClip = perspectiveProjection(0.7f, 1.5f, 0.1f);
  return view;
}

TEST(ViewCheck, projectionsOfOurConventionAreGood) {
  View view = goodView();
  EXPECT_EQ(problemWith(view), "");
  view.eyeToClip[2][0] = 0.3f, view.eyeToClip[2][1] = -0.2f;  // off-centre, as headsets have them
  EXPECT_EQ(problemWith(view), "");
  view.eyeToClip = orthographicProjection(2, 1.5f, -1, 100);
  EXPECT_EQ(problemWith(view), "");
  // With a far plane, rolled, and of a scaled world.
  view = goodView();
  const float near = 0.1f, far = 1000;
  view.eyeToClip[2][2] = near / (far - near), view.eyeToClip[3][2] = near * far / (far - near);
  EXPECT_EQ(problemWith(view), "");
  view.eyeToClip = glm::rotate(glm::mat4(1), 1.6f, glm::vec3(0, 0, 1)) * view.eyeToClip;
  view.worldToEye = view.worldToEye * glm::scale(glm::mat4(1), glm::vec3(1e-6f));
  EXPECT_EQ(problemWith(view), "");
}

TEST(ViewCheck, othersAreNot) {
  const float f = 2;
  const std::pair<const char*, std::function<void(View&)>> slips[] = {
      {"places no eye", [](View& v) { v.worldToEye = glm::mat4(0); }},
      {"places no eye", [](View& v) { v.worldToEye[0] = glm::vec4(0); }},
      {"places no eye", [](View& v) { v.worldToEye[1] = v.worldToEye[0]; }},
      {"places no eye", [](View& v) { v.worldToEye = glm::transpose(v.worldToEye); }},
      {"shows nothing", [](View& v) { v.eyeToClip = glm::mat4(0); }},
      {"shows nothing", [](View& v) { v.eyeToClip[2][3] = 1; }},  // looking along +z
      // Depth from 0 near to 1 far, from -1 to 1, both with y up; and reversed with y up.
      {"depth", [&](View& v) { v.eyeToClip = glm::perspectiveRH_ZO(0.7f, 1.5f, 0.1f, 100.0f); }},
      {"depth", [&](View& v) { v.eyeToClip = glm::perspectiveRH_NO(0.7f, 1.5f, 0.1f, 100.0f); }},
      {"depth", [&](View& v) { v.eyeToClip = glm::orthoRH_ZO(-f, f, -f, f, 0.1f, 100.0f); }},
      {"depth", [&](View& v) { v.eyeToClip[3][2] = 0; }},
      {"y down", [](View& v) { v.eyeToClip[1][1] *= -1; }},
      {"y down", [](View& v) { v.eyeToClip[0][0] = 0; }},
      {"not finite", [](View& v) { v.eyeToClip[0][0] = std::numeric_limits<float>::quiet_NaN(); }}};
  for (const auto& [says, slip] : slips) {
    View view = goodView();
    slip(view);
    EXPECT_NE(problemWith(view).find(says), std::string::npos) << says << ": " << problemWith(view);
  }
}

}  // namespace
}  // namespace scumble::stage
