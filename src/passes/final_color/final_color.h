// The picture: the colour pass warped by the warp pass, with bloom (paper 000, Final Color).
#pragma once

#include "frame/pass.h"

namespace scumble::passes {

#define PARAMS_STRUCT FinalColorParams
#define PARAMS_FILE "passes/final_color/final_color.params"
#define PARAMS_PATH "final"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

// What the warp pass says: the largest inflation of any of the scene's materials, in pixels.
using InflationOf = float (*)(const look::LookData& look, const frame::SceneOnGpu& scene, float imageHeight);

std::unique_ptr<frame::Pass> makeFinalColor(InflationOf inflation);

}  // namespace scumble::passes
