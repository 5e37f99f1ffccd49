// How far a scene has travelled over its ocean.
#pragma once

#include "look/look_data.h"

namespace scumble::frame {

// Metres along x and z at a time in seconds: the integral, from time 0, of the velocity that `ocean.speed`
// and `ocean.heading` give. `look` has its tracks. A pure function; exact where nothing changes, and else to
// a thousandth of a millimetre a second.
glm::dvec2 travelledAt(const look::LookData& look, double time);

}  // namespace scumble::frame
