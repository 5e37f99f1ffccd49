// Knobs of shadow shapes, and what follows from them.
#pragma once

#include "look/look_data.h"

namespace scumble::passes {

#define PARAMS_STRUCT FinalShadowParams
#define PARAMS_FILE "passes/final_shadow/final_shadow.params"
#define PARAMS_PATH "shadow"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

// The edges between light and shadow: amounts of light, the first of them and the distance to the next.
struct StepThresholds {
  float darkest, spacing;
};
StepThresholds stepThresholds(const FinalShadowParams& params);

// How far the light must fall below `begin`, as a part of it, for the glow to be full: what is left of the
// light beside a straight edge at `width` of the way from that edge to where the blurred light ends.
float glowReach(float width, float begin);

// What is left of the light deep in the dark, where the blurred light ends: that of the glow, as the pass
// `final_shadow` stores it.
float deepGlow(const FinalShadowParams& params);

// Whether breakup marks count.
inline bool shadesByMarks(const FinalShadowParams& params) {
  return params.indication > 0 || params.dither > 0;
}

// Whether light and shadow are themselves wherever no edge of theirs is near. A dither reaches everywhere.
inline bool isPlainApartFromEdges(const FinalShadowParams& params) {
  return params.dither <= 0;
}

}  // namespace scumble::passes
