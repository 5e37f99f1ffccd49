// Lit and shadowed colours mixed by the final shadow, in the air, over the sky (paper 000, Color Pass).
#pragma once

#include "frame/pass.h"

namespace scumble::passes {

#define PARAMS_STRUCT BackgroundParams
#define PARAMS_FILE "passes/color/color.params"
#define PARAMS_PATH "background"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

std::unique_ptr<frame::Pass> makeColor();

}  // namespace scumble::passes
