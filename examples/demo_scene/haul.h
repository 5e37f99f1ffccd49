// The old sailor hauls in the sheet: he hangs his weight on it, draws it to his chest, and reaches for
// more, hand over hand.
#pragma once

#include <array>

#include "sailor_form.h"

namespace demo {

constexpr float kHaulFrames = 96.0f;  // the length of his cycle

struct Haul {
  glm::vec3 hips{0.0f};                     // where the hips are
  std::array<glm::quat, kBoneCount> turns;  // each bone's, from how it was built, in its parent's
  glm::vec3 grip{0.0f};                     // where the sheet leaves his lower hand, in his space
};

Haul haulAt(float frame);

}  // namespace demo
