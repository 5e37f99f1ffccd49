// Knobs of the picture as a whole.
#pragma once

#include "look/look_data.h"

namespace scumble::passes {

#define PARAMS_STRUCT FinalColorParams
#define PARAMS_FILE "passes/final_color/final_color.params"
#define PARAMS_PATH "final"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

}  // namespace scumble::passes
