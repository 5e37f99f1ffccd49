// Knobs of how the ocean is painted.
#pragma once

#include "look/look_data.h"

namespace scumble::passes {

#define PARAMS_STRUCT OceanPaintParams
#define PARAMS_FILE "passes/ocean/ocean_paint.params"
#define PARAMS_PATH "ocean.paint"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

}  // namespace scumble::passes
