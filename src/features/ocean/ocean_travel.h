// How far a scene has travelled over its ocean.
#pragma once

#include <functional>

#include "look/look_data.h"

namespace scumble::ocean {

// Metres along x and z at a time in seconds.
using Travelled = std::function<glm::dvec2(double)>;

// The integral, from time 0, of the velocity that `ocean.speed` and `ocean.heading` give. `look` has its
// tracks, and stays. A pure function; exact where nothing changes, and else to a thousandth of a millimetre a
// second.
Travelled travelledBy(const look::LookData& look);

}  // namespace scumble::ocean
