// The picture: the colour pass warped by the warp pass, with bloom (paper 000, Final Color).
#pragma once

#include "frame/pass.h"

namespace scumble::passes {

#define PARAMS_STRUCT FinalColorParams
#define PARAMS_FILE "passes/final_color/final_color.params"
#define PARAMS_PATH "final"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

// What the passes of surfaces say.
struct SurfaceFacts {
  // The largest inflation of any of the scene's materials, in pixels.
  float (*inflation)(const look::LookData& look, const world::SceneOnGpu& scene, float imageHeight);
  // Whether anything may act on the lens at any time.
  bool (*glow)(const look::LookData& look, const scene::SceneData& scene);
};

std::unique_ptr<frame::Pass> makeFinalColor(const SurfaceFacts& surfaces);

}  // namespace scumble::passes
