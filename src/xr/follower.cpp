#include "xr/follower.h"

#include <cmath>

namespace scumble::xr {

glm::quat upright(const glm::quat& turn) {
  const glm::vec3 back = turn * glm::vec3(0, 0, 1), side = glm::cross(glm::vec3(0, 1, 0), back);
  const float length = glm::length(side);
  if (length < 1e-3f) return turn;
  const glm::vec3 right = side / length;
  return glm::normalize(glm::quat_cast(glm::mat3(right, glm::cross(back, right), back)));
}

Pose Follower::go(const Pose& head, float seconds) {
  const Pose wanted{upright(head.turn), head.place};
  const float share = pose_ && inertia_ > 0 ? 1 - std::exp(-seconds / inertia_) : 1;
  pose_ = pose_ ? Pose{upright(glm::slerp(pose_->turn, wanted.turn, share)),
                       glm::mix(pose_->place, wanted.place, share)}
                : wanted;
  return *pose_;
}

}  // namespace scumble::xr
