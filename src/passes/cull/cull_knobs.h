// Knobs of levels of detail.
#pragma once

#include "look/look_data.h"

namespace scumble::passes {

#define PARAMS_STRUCT LevelsParams
#define PARAMS_FILE "passes/cull/levels.params"
#define PARAMS_PATH "levels"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

}  // namespace scumble::passes
