// The blur's knobs, and what follows from them.
#pragma once

#include "look/look_data.h"

namespace scumble::passes {

#define PARAMS_STRUCT BlurParams
#define PARAMS_FILE "passes/blur/blur.params"
#define PARAMS_PATH "blur"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

// How the blur's variance is shared among its steps.
struct BlurPlan {
  float quarterSigma;  // of the steps that go to a quarter of the size, in texels of their sources
  float fullSigma;     // of the last two steps, in texels at a quarter of the size; 0: they only copy
  float amount;        // how much of the blurred image counts: less than 1 for tiny radii
};
// `radius`: twice the standard deviation wanted, in pixels of the full size.
BlurPlan planBlur(float radius);

// How far blurred light comes from at the most, in pixels, for that radius.
float blurReach(float radius);

// How quickly taps lose their weight with relative depth, for a depth edge that is that large; 0 for none.
float depthSharpness(float depthEdge);

}  // namespace scumble::passes
