// Warp vectors on the inflated surface (paper 000, section 4).
#pragma once

#include "frame/pass.h"

namespace scumble::passes {

#define PARAMS_STRUCT WarpParams
#define PARAMS_FILE "passes/warp/warp.params"
#define PARAMS_PATH "warp"
#define PARAMS_PER_MATERIAL true
#include "look/define_params.h"

std::unique_ptr<frame::Pass> makeWarp();

}  // namespace scumble::passes
