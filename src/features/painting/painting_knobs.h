// Knobs of paintings in space.
#pragma once

#include "look/look_data.h"

namespace scumble::painting {

#define PARAMS_STRUCT PaintingParams
#define PARAMS_FILE "features/painting/painting.params"
#define PARAMS_PATH "painting"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

}  // namespace scumble::painting
