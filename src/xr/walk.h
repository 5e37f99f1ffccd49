// Where hands take whoever wears a headset: arithmetic alone.
#pragma once

#include <glm/glm.hpp>

#include "xr/place.h"

namespace scumble::xr {

// What sticks say, -1 to 1: x to the right, y ahead; and turning to the right.
struct Steering {
  glm::vec2 walk{0};
  float turn = 0;
  bool mayTurn = true;  // else a push is over before it turns anything
};

constexpr float kWalkSpeed = 1.5f;   // metres of the room a second
constexpr float kStickRest = 0.2f;   // of a stick's way in which it rests
constexpr float kTurnAngle = 30;     // degrees that a push turns by, at once: smooth turns make people sick
constexpr float kTurnPush = 0.7f;    // of a stick's way that is a push, and
constexpr float kTurnReturn = 0.4f;  // where it may be pushed again

// Pushes of a stick: each counts once.
class Push {
 public:
  // -1 or 1 as it is pushed that way, and 0 until it was back and is pushed anew.
  int go(float stick);

 private:
  bool isPushed_ = false;
};

// What has been walked and turned beyond a stand. Walking goes where the head looks, on the level; turning
// goes around the head.
class Walk {
 public:
  // The stand with it, for a head (in the room).
  Stand on(const Stand& stand) const;
  // Goes on for so many seconds.
  void go(const Stand& stand, const Pose& head, const Steering& steering, float seconds);
  // Back to where the stand is. A push that lasts turns nothing anew.
  void reset() { place_ = glm::vec3(0), heading_ = 0; }
  // From 0, at rest, to 1 at full speed: how much of the edges is to be dark.
  float motion() const { return motion_; }

 private:
  glm::vec3 place_{0};  // metres of the scene, in the stand's own axes
  float heading_ = 0;   // radians
  float motion_ = 0;
  Push turn_;
};

}  // namespace scumble::xr
