// Tests only: what a view looks at, and from where.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "scumble/view.h"

namespace scumble {

inline glm::vec3 eyeOf(const View& view) {
  return glm::vec3(glm::inverse(view.worldToEye)[3]);
}
inline glm::vec3 axisOf(const View& view) {
  return -glm::vec3(glm::inverse(view.worldToEye)[2]);
}
// Vertical, degrees.
inline float fovOf(const View& view) {
  return glm::degrees(2 * std::atan(1 / -view.eyeToClip[1][1]));
}
inline void expectClose(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-3f) {
  EXPECT_LT(glm::length(a - b), tolerance)
      << a.x << " " << a.y << " " << a.z << ", not " << b.x << " " << b.y << " " << b.z;
}

}  // namespace scumble
