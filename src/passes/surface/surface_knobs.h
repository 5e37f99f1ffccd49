// Knobs of surfaces, and of the textures that a look paints on them.
#pragma once

#include "look/look_data.h"
#include "scene/scene_data.h"

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

// Light between surfaces.
#define PARAMS_STRUCT IndirectParams
#define PARAMS_FILE "passes/surface/indirect.params"
#define PARAMS_PATH "indirect"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

// Whether anything may take light from other surfaces, of a look at its time.
bool mayTakeIndirect(const look::LookData& look);

// surface.simplify in mip levels of a picture that is `pixelScale` times as high as 1080 lines: what is left
// out has the same size in all of them.
float mipBias(float simplify, float pixelScale);

// Whether anything may act on the lens at any time.
bool mayGlow(const look::LookData& look, const scene::SceneData& scene);

}  // namespace scumble::passes
