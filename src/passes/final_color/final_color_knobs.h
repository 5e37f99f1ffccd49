// Knobs of the picture as a whole.
#pragma once

#include "look/look_data.h"

namespace scumble::passes {

#define PARAMS_STRUCT FinalColorParams
#define PARAMS_FILE "passes/final_color/final_color.params"
#define PARAMS_PATH "final"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

// How far colours of lost edges run into each other, pixels; 0 where none are lost. `pixelScale`: pixels per
// knob pixel.
inline float lostReach(const FinalColorParams& params, float pixelScale) {
  return params.lostEdges > 0 ? params.lostWidth * pixelScale : 0;
}

}  // namespace scumble::passes
