// Shadow shapes: threshold, inner glow, indication (paper 000, section 5.1).
#pragma once

#include "frame/pass.h"

namespace scumble::passes {

#define PARAMS_STRUCT FinalShadowParams
#define PARAMS_FILE "passes/final_shadow/final_shadow.params"
#define PARAMS_PATH "shadow"
#define PARAMS_PER_MATERIAL false
#include "look/define_params.h"

// `blurAmount`: how much of the blurred image counts, for a look and a scale of pixels; the blur pass knows.
using BlurAmount = float (*)(const look::LookData& look, float pixelScale);
std::unique_ptr<frame::Pass> makeFinalShadow(BlurAmount blurAmount);

}  // namespace scumble::passes
