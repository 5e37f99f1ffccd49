// The shadow channels and both colours of every surface, in one geometry pass (paper 000, Shadow Pass and the
// geometry half of the Color Pass; FORMULAS 14).
#pragma once

#include "frame/pass.h"

namespace scumble::passes {

#define PARAMS_STRUCT SurfaceParams
#define PARAMS_FILE "passes/surface/surface.params"
#define PARAMS_PATH "surface"
#define PARAMS_TARGETS kScene | kMaterials | kNodes
#include "look/define_params.h"

// A texture that the look paints on a material, by MetaTexture.
#define PARAMS_STRUCT TextureParams
#define PARAMS_FILE "passes/surface/texture.params"
#define PARAMS_PATH "texture"
#define PARAMS_TARGETS kScene | kMaterials
#include "look/define_params.h"

// Behind the first surfaces light is thresholded without a blur.
std::unique_ptr<frame::Pass> makeSurface(frame::Layer layer);

}  // namespace scumble::passes
