#include "xr/walk.h"

#include <algorithm>
#include <cmath>

namespace scumble::xr {

int Push::go(float stick) {
  const float way = std::abs(stick);
  if (way < kTurnReturn) isPushed_ = false;
  if (isPushed_ || way < kTurnPush) return 0;
  isPushed_ = true;
  return stick < 0 ? -1 : 1;
}

Stand Walk::on(const Stand& stand) const {
  Stand walked = stand;
  walked.place += aboutVertical(stand.heading) * place_;
  walked.heading += heading_;
  return walked;
}

void Walk::go(const Stand& stand, const Pose& head, const Steering& steering, float seconds) {
  const float push = glm::length(steering.walk);
  motion_ = std::clamp((push - kStickRest) / (1 - kStickRest), 0.0f, 1.0f);
  if (motion_ > 0) {
    // Ahead is where the head looks in the room; whoever looks straight up or down goes where the top of the
    // head or the chin is.
    const glm::vec3 back = head.turn * glm::vec3(0, 0, 1), up = head.turn * glm::vec3(0, 1, 0);
    glm::vec2 ahead(-back.x, -back.z);
    if (glm::length(ahead) < 1e-3f) ahead = back.y > 0 ? glm::vec2(up.x, up.z) : -glm::vec2(up.x, up.z);
    ahead = glm::normalize(ahead);
    const glm::vec2 right(-ahead.y, ahead.x), way = steering.walk / push;
    const glm::vec2 step = (way.x * right + way.y * ahead) * (motion_ * kWalkSpeed * seconds * stand.scale);
    place_ += aboutVertical(heading_) * glm::vec3(step.x, 0, step.y);
  }
  const int turn = turn_.go(steering.turn);
  if (turn == 0 || !steering.mayTurn) return;
  // The head stays where it is.
  const auto headPlace = [&] { return place_ + stand.scale * (aboutVertical(heading_) * head.place); };
  const glm::vec3 before = headPlace();
  heading_ -= float(turn) * glm::radians(kTurnAngle);
  place_ += before - headPlace();
}

}  // namespace scumble::xr
