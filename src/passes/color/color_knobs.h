// Knobs of the background and the air.
#pragma once

#include "look/look_data.h"
#include "shading/frame.shared.h"

namespace scumble::passes {

#define PARAMS_STRUCT BackgroundParams
#define PARAMS_FILE "passes/color/color.params"
#define PARAMS_PATH "background"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

// Where the air begins to count, and where nothing else is left: metres along the view axis, the same for all
// views.
glm::vec2 airDistances(const BackgroundParams& params, const shared::FrameUniforms& frame);

}  // namespace scumble::passes
