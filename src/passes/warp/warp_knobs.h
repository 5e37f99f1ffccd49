// Knobs of torn edges, and what follows from them.
#pragma once

#include "look/look_data.h"

namespace scumble::passes {

#define PARAMS_STRUCT WarpParams
#define PARAMS_FILE "passes/warp/warp.params"
#define PARAMS_PATH "warp"
#define PARAMS_TARGETS kScene | kMaterials
#include "look/define_params.h"

#define PARAMS_STRUCT BreakupParams
#define PARAMS_FILE "passes/warp/breakup.params"
#define PARAMS_PATH "breakup"
#define PARAMS_TARGETS kScene | kMaterials
#include "look/define_params.h"

// The inflation in pixels of a picture.
float inflationPixels(const WarpParams& params, float imageHeight);

// The drawing that line boil shows at a time, from 0: it changes on the grid of 24 frames a second only,
// however often the picture is drawn (FORMULAS 11).
int boilDrawing(const WarpParams& params, double time);

}  // namespace scumble::passes
