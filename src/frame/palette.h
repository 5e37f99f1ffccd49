// The palette rule: from a surface's own colour to its colours in light and in shadow, for scenes that nobody
// prepared. Light is warm, shadow is cool and a colour of its own, never grey times the lit one
// (docs/palette.md).
#pragma once

#include <functional>

#include "frame/scene_on_gpu.h"
#include "look/look_data.h"

namespace scumble::frame {

#define PARAMS_STRUCT PaletteParams
#define PARAMS_FILE "frame/palette.params"
#define PARAMS_PATH "palette"
#define PARAMS_TARGETS kScene | kMaterials
#include "look/define_params.h"

#define PARAMS_STRUCT GroundParams
#define PARAMS_FILE "frame/ground.params"
#define PARAMS_PATH "ground"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

// The rule itself, in OKLab. Linear RGB in and out, clipped to sRGB.
glm::dvec3 litColor(const PaletteParams& params, const glm::dvec3& albedo);
glm::dvec3 shadowedColor(const PaletteParams& params, const glm::dvec3& albedo);

// A rule carried to the GPU: its quadratic polynomial in the square root of linear RGB, nearest by least
// squares over the colours of sRGB. Shaders evaluate this, since the rule itself needs a cube root for each
// channel and a search for the gamut.
shared::ColorMap fitColorMap(const std::function<glm::dvec3(const glm::dvec3&)>& rule);
// The map that gives one colour for everything.
shared::ColorMap constantColorMap(const glm::vec3& linear);
shared::ColorMap identityColorMap();
// What a shader makes of it (src/shading/color_map.glsl).
glm::vec3 apply(const shared::ColorMap& map, const glm::vec3& linear);

// Whether a ground is put under this scene. Before a picture, any scene gets one that shows only shadows.
bool hasGround(const scene::SceneData& scene, const look::LookData& look, bool overPicture);

struct BackgroundColors {
  glm::vec3 horizon, zenith, ground;  // linear
};
// A quiet background, two steps of value away from the scene.
BackgroundColors automaticBackground(const SceneColors& colors);

}  // namespace scumble::frame
