// Somebody who looks over the shoulder of whoever wears a headset, with a steadier head: for those who watch
// on a screen. Arithmetic alone.
#pragma once

#include <optional>

#include "xr/place.h"

namespace scumble::xr {

class Follower {
 public:
  // `inertia`: seconds in which it comes nearer by two thirds; 0: at once.
  explicit Follower(float inertia) : inertia_(inertia) {}

  // Where it looks from, by where a head is, so many seconds later: upright, whatever the head does.
  Pose go(const Pose& head, float seconds);

 private:
  float inertia_;
  std::optional<Pose> pose_;
};

// The same way, with the horizon level. Straight up or down stays as it is.
glm::quat upright(const glm::quat& turn);

}  // namespace scumble::xr
