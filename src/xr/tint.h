// A material's colours in a hand: they turn with the wrist, and get lighter as the hand is raised.
#pragma once

#include <string>
#include <vector>

#include "scumble/look.h"
#include "xr/place.h"

namespace scumble::xr {

constexpr float kLightnessHeight = 0.25f;  // metres of the room that double how light it is, or halve it

class Tint {
 public:
  // Of a material, as the look has its colours in light and in shadow at a time. Fails with usage where it
  // has no name.
  static Result<Tint> take(const Look& look, const std::string& material, double time, const Pose& hand);

  // Sets the look's knobs as the hand, in the room, has moved since.
  Status follow(Look& look, const Pose& hand);
  // What was set, as options of the program: "--set materials.Sail.lit.hue=40 ...". Empty: nothing yet.
  std::string told() const;

 private:
  struct Knob {
    std::string path;
    double before = 0, now = 0;
  };
  std::vector<Knob> hues_, brightnesses_;
  Pose hand_;
  float turned_ = 0;  // radians, beyond a full turn too
};

// By how far a hand is rolled about where it points, from another one, radians clockwise as seen by whoever
// points: -pi to pi.
float rollBetween(const Pose& from, const Pose& to);

}  // namespace scumble::xr
