// The palette rule: from a surface's own colour to its colours in light and in shadow, for scenes that nobody
// prepared. Light is warm, shadow is cool and a colour of its own, never grey times the lit one
// (docs/palette.md).
#pragma once

#include <array>
#include <functional>

#include "look/look_data.h"
#include "scene/scene_data.h"
#include "shading/frame.shared.h"

namespace scumble::stage {

#define PARAMS_STRUCT PaletteParams
#define PARAMS_FILE "stage/palette.params"
#define PARAMS_PATH "palette"
#define PARAMS_TARGETS kScene | kMaterials | kNodes
#include "look/define_params.h"

// The two sets of colours, in light and in shadow: where they come from, and how they are graded.
#define PARAMS_STRUCT LitParams
#define PARAMS_FILE "stage/color_set.params"
#define PARAMS_PATH "lit"
#define PARAMS_TARGETS kScene | kMaterials | kNodes
#include "look/define_params.h"

#define PARAMS_STRUCT ShadowedParams
#define PARAMS_FILE "stage/color_set.params"
#define PARAMS_PATH "shadowed"
#define PARAMS_TARGETS kScene | kMaterials | kNodes
#include "look/define_params.h"

#define PARAMS_STRUCT GroundParams
#define PARAMS_FILE "stage/ground.params"
#define PARAMS_PATH "ground"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

// The names of LitParams::texture.
enum SetSource : int32_t { kSetOfScene, kSetDerived };

// The rule itself, in OKLab. Linear RGB in and out, clipped to sRGB.
glm::dvec3 litColor(const PaletteParams& params, const glm::dvec3& albedo);
glm::dvec3 shadowedColor(const PaletteParams& params, const glm::dvec3& albedo);

// How a set's colours are graded, whichever side of the shadow it is for. All members are 4 bytes.
struct Grade {
  float hue = 0, saturation = 1, brightness = 1, contrast = 1, overlayAmount = 0;
  glm::vec3 overlay{0.0f};
  // Without the overlay where none of it is laid over, so that equal grades are equal.
  template <class Params>
  static Grade of(const Params& p) {
    return {p.hue,      p.saturation,    p.brightness,
            p.contrast, p.overlayAmount, p.overlayAmount > 0 ? p.overlay.linear : glm::vec3(0.0f)};
  }
  bool operator==(const Grade&) const = default;
};
// In OKLab; linear RGB in and out. Nothing changes under the defaults, to the bit.
glm::dvec3 graded(const Grade& grade, const glm::dvec3& color);

// From a surface's own colour to one of its two colours: the palette rule's, or the colour itself as painted,
// graded.
struct ColorRule {
  enum Side : uint32_t { lit, shadowed, painted };
  Side side = painted;
  PaletteParams palette{};
  Grade grade{};
  glm::dvec3 operator()(const glm::dvec3& albedo) const;
};

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

// What the automatic choices of colours need to know of a scene.
struct SceneColors {
  // How many values are told apart, from black to white in OKLab lightness.
  static constexpr size_t kValues = 16;
  glm::vec3 meanRootRgb{0.5f};          // square root of linear RGB, averaged over the surface
  float variety = 0;                    // its standard deviation there
  std::array<float, kValues> values{};  // what part of the surface has each; all 0 where there is none
};
// A piece of a surface.
struct ColorSample {
  double area = 0;
  glm::dvec3 root{0.0};  // square root of linear RGB
};
// Over any number of pieces.
class SceneColorSum {
 public:
  void add(const ColorSample& sample);
  void add(const SceneColorSum& other);
  SceneColors colors() const;

 private:
  glm::dvec3 sum_{0.0}, squares_{0.0};
  std::array<double, SceneColors::kValues> values_{};
  double area_ = 0;
};

// Of colours in the light, for planes that face the sky and such as turn away from the light, against those
// that face the light: factors. `planes`: the knob; a scene of many colours has less of it.
struct PlaneTints {
  glm::vec3 sky{1.0f}, turned{1.0f};
};
PlaneTints planeTints(float planes, const SceneColors& colors);

struct BackgroundColors {
  glm::vec3 horizon, zenith, ground;  // linear
};
// A quiet background, two steps of value away from as much of the scene as can be, in light and in shadow.
BackgroundColors automaticBackground(const SceneColors& colors);

}  // namespace scumble::stage
