#include "camera.h"

#include <algorithm>

namespace scumble::viewer {

void Camera::setBounds(const SceneSummary& summary) {
  constexpr float kLeast = 1e-6f;  // metres
  glm::dvec3 low, high;
  for (int i = 0; i < 3; ++i) low[i] = summary.min[i], high[i] = summary.max[i];
  centre_ = 0.5 * (low + high), radius_ = std::max(float(0.5 * glm::distance(low, high)), kLeast);
}

Navigation& Camera::hold(const std::optional<View>& present) {
  if (!isHeld_ && present) {
    navigation_.takeUp(*present, centre_, radius_);
    isHeld_ = true;
  }
  ++moves_;
  return navigation_;
}

void Camera::set(const std::optional<Viewpoint>& viewpoint) {
  base_ = viewpoint, isHeld_ = false;
  ++moves_;
}

}  // namespace scumble::viewer
