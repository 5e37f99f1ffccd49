// Knobs of who casts shadows.
#pragma once

#include "look/look_data.h"

namespace scumble::passes {

#define PARAMS_STRUCT ShadowMapParams
#define PARAMS_FILE "passes/shadow_map/shadow_map.params"
#define PARAMS_PATH "shadowMap"
#define PARAMS_TARGETS kScene | kMaterials
#include "look/define_params.h"

}  // namespace scumble::passes
