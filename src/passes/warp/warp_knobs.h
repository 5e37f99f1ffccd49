// Knobs of torn edges, and what follows from them.
#pragma once

#include "look/look_data.h"
#include "stage/knob_table.h"

namespace scumble::passes {

#define PARAMS_STRUCT WarpParams
#define PARAMS_FILE "passes/warp/warp.params"
#define PARAMS_PATH "warp"
#define PARAMS_TARGETS kScene | kMaterials | kNodes
#include "look/define_params.h"

#define PARAMS_STRUCT BreakupParams
#define PARAMS_FILE "passes/warp/breakup.params"
#define PARAMS_PATH "breakup"
#define PARAMS_TARGETS kScene | kMaterials
#include "look/define_params.h"

// The inflation in pixels of a picture.
float inflationPixels(const WarpParams& params, float imageHeight);

// The drawing that line boil shows at a time, from 0, where each stands for `hold` frames and `drawings` take
// turns: it changes on the grid of 24 frames a second only, however often the picture is drawn (FORMULAS 11).
// What is held for 0 frames has a drawing for each.
int boilDrawing(int drawings, int hold, double time);

// Whether anything may be torn.
bool mayTear(const look::LookData& look);

// Where breakup marks count: in edges of light and shadow that are indicated, or everywhere.
enum class MarksUse : uint8_t { none, shaded, everywhere };
MarksUse marksUse(const stage::KnobTable& knobs);

}  // namespace scumble::passes
