// The palette rule: from a surface's own colour to its colours in light and in shadow, for scenes that nobody prepared.
// Light is warm, shadow is cool and a colour of its own, never grey times the lit one (docs/palette.md).
#pragma once

#include <functional>

#include "frame/scene_on_gpu.h"
#include "look/look_data.h"

namespace scumble::frame {

#define PARAMS_STRUCT PaletteParams
#define PARAMS_FILE "frame/palette.params"
#define PARAMS_PATH "palette"
#define PARAMS_PER_MATERIAL true
#include "look/define_params.h"

#define PARAMS_STRUCT GroundParams
#define PARAMS_FILE "frame/ground.params"
#define PARAMS_PATH "ground"
#define PARAMS_PER_MATERIAL false
#include "look/define_params.h"

// The rule itself, in OKLab. Linear RGB in and out, clipped to sRGB.
glm::dvec3 litColor(const PaletteParams& params, const glm::dvec3& albedo);
glm::dvec3 shadowedColor(const PaletteParams& params, const glm::dvec3& albedo);

// An affine map of the square root of linear RGB.
struct AffineColorMap {
  glm::mat3 matrix{1.0f};
  glm::vec3 offset{0.0f};
  glm::vec3 apply(const glm::vec3& linear) const;
};

// The affine map nearest to a rule over the colours of sRGB (least squares): what shaders evaluate, since a cube root
// each for three channels at every fragment would cost more than the rest of the surface pass.
AffineColorMap fitColorMap(const std::function<glm::dvec3(const glm::dvec3&)>& rule);

// Whether a ground is put under this scene.
bool hasGround(const scene::SceneData& scene, const look::LookData& look);

struct BackgroundColors {
  glm::vec3 horizon, zenith, ground;  // linear
};
// A quiet background, two steps of value away from the scene.
BackgroundColors automaticBackground(const SceneColors& colors);

}  // namespace scumble::frame
