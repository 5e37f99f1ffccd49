// Knobs of lines.
#pragma once

#include <algorithm>

#include "look/look_data.h"
#include "scene/scene_data.h"

namespace scumble::ink {

#define PARAMS_STRUCT InkParams
#define PARAMS_FILE "features/ink/ink.params"
#define PARAMS_PATH "ink"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

// Lines of one material.
#define PARAMS_STRUCT LineParams
#define PARAMS_FILE "features/ink/ink_line.params"
#define PARAMS_PATH "ink.line"
#define PARAMS_TARGETS kScene | kMaterials | kNodes
#include "look/define_params.h"

// Kinds of lines.
#define INK_KIND_SHOWN 1
#define INK_KIND_WIDTH 1.0
#define PARAMS_STRUCT SilhouetteParams
#define PARAMS_FILE "features/ink/ink_kind.params"
#define PARAMS_PATH "ink.silhouettes"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"
#undef INK_KIND_WIDTH

#define INK_KIND_WIDTH 0.5
#define PARAMS_STRUCT CreaseParams
#define PARAMS_FILE "features/ink/ink_kind.params"
#define PARAMS_PATH "ink.creases"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

#define PARAMS_STRUCT MaterialBorderParams
#define PARAMS_FILE "features/ink/ink_kind.params"
#define PARAMS_PATH "ink.materials"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"
#undef INK_KIND_SHOWN

#define INK_KIND_SHOWN 0
#define PARAMS_STRUCT ColorBorderParams
#define PARAMS_FILE "features/ink/ink_kind.params"
#define PARAMS_PATH "ink.colors"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"
#undef INK_KIND_SHOWN
#undef INK_KIND_WIDTH

#define INK_KIND_SHOWN 1
#define INK_KIND_WIDTH 0.8
#define PARAMS_STRUCT BoundaryParams
#define PARAMS_FILE "features/ink/ink_kind.params"
#define PARAMS_PATH "ink.boundaries"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"
#undef INK_KIND_SHOWN
#undef INK_KIND_WIDTH

#define INK_KIND_SHOWN 0
#define INK_KIND_WIDTH 0.5
#define PARAMS_STRUCT ShadowShapeParams
#define PARAMS_FILE "features/ink/ink_kind.params"
#define PARAMS_PATH "ink.shadows"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

#define PARAMS_STRUCT LightStepParams
#define PARAMS_FILE "features/ink/ink_kind.params"
#define PARAMS_PATH "ink.steps"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

#define PARAMS_STRUCT ObjectBorderParams
#define PARAMS_FILE "features/ink/ink_kind.params"
#define PARAMS_PATH "ink.objects"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

#define PARAMS_STRUCT IntersectionParams
#define PARAMS_FILE "features/ink/ink_kind.params"
#define PARAMS_PATH "ink.intersections"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"
#undef INK_KIND_SHOWN
#undef INK_KIND_WIDTH

#define INK_KIND_SHOWN 1
#define INK_KIND_WIDTH 0.8
#define PARAMS_STRUCT CutOutParams
#define PARAMS_FILE "features/ink/ink_kind.params"
#define PARAMS_PATH "ink.cutouts"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"
#undef INK_KIND_SHOWN
#undef INK_KIND_WIDTH

// Whether a look, at its time, draws lines; such around shadow shapes or steps of light; and such as follow
// from which pieces of meshes are seen.
inline bool mayShow(const look::LookData& look) {
  return look.get<InkParams>().shown;
}
inline bool mayShowShadows(const look::LookData& look) {
  return mayShow(look) && (look.get<ShadowShapeParams>().shown || look.get<LightStepParams>().shown);
}
inline bool mayShowPieces(const scene::SceneData& scene, const look::LookData& look) {
  if (!mayShow(look)) return false;
  if (look.get<ObjectBorderParams>().shown || look.get<IntersectionParams>().shown) return true;
  // What has no holes is not cut out.
  return look.get<CutOutParams>().shown &&
         std::any_of(scene.materials.begin(), scene.materials.end(), [](const scene::Material& material) {
           return material.alphaMode != scene::AlphaMode::opaque && !material.paint;
         });
}

}  // namespace scumble::ink
