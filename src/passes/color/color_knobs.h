// Knobs of the background and the air.
#pragma once

#include "look/look_data.h"

namespace scumble::passes {

#define PARAMS_STRUCT BackgroundParams
#define PARAMS_FILE "passes/color/color.params"
#define PARAMS_PATH "background"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

}  // namespace scumble::passes
