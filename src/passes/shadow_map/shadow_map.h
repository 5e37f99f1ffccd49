// Depth from the light in sigmoid-warped light space, once a frame (paper 000, "Depth Pass").
#pragma once

#include "frame/pass.h"

namespace scumble::passes {

#define PARAMS_STRUCT ShadowMapParams
#define PARAMS_FILE "passes/shadow_map/shadow_map.params"
#define PARAMS_PATH "shadowMap"
#define PARAMS_TARGETS kScene | kMaterials
#include "look/define_params.h"

std::unique_ptr<frame::Pass> makeShadowMap();

}  // namespace scumble::passes
