// Where the spars are; the sails and the ropes ask here. Boat space, metres.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "hull_form.h"

namespace demo {

// The sheets are eased to starboard, to leeward and away from the viewer, so that mast, gaff and jib draw
// on the hollow side of the mainsail; the gaff sags off further than the boom.
constexpr float kBoomAngle = 0.09f, kGaffAngle = 0.26f;                       // radians off the centre line
constexpr float kBoomLength = 2.16f, kGaffLength = 2.30f, kGaffRise = 0.88f;  // metres, metres, radians

inline glm::vec3 mastPoint(float y) {
  return {kMastFoot - 0.035f * (y - 0.6f), y, 0};
}
constexpr float kMastTop = 5.72f;

// Along the boom and the gaff, 0 at the mast, 1 at the end.
inline glm::vec3 boomPoint(float u) {
  const float r = 0.10f + u * kBoomLength;
  return mastPoint(1.54f) + glm::vec3(-r * std::cos(kBoomAngle), 0.30f * u, r * std::sin(kBoomAngle));
}
inline glm::vec3 gaffPoint(float u) {
  const float r = 0.10f + u * kGaffLength, level = r * std::cos(kGaffRise);
  return mastPoint(3.72f) +
         glm::vec3(-level * std::cos(kGaffAngle), r * std::sin(kGaffRise), level * std::sin(kGaffAngle));
}

inline glm::vec3 bowspritPoint(float u) {
  return glm::mix(glm::vec3(2.0f, 1.06f, 0), glm::vec3(3.72f, 1.42f, 0), u);
}

// The block under the boom that the sheet comes from to the sailor's hands.
inline glm::vec3 sheetBlock() {
  return boomPoint(0.84f) + glm::vec3(0.0f, -0.15f, 0.0f);
}

}  // namespace demo
