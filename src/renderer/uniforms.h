// What set 0 holds, computed from views, scene and look.
#pragma once

#include <optional>

#include "frame/pass.h"
#include "scumble/renderer.h"
#include "stage/palette.h"
#include "world/look_textures.h"

namespace scumble::renderer {

using namespace frame;

shared::ViewUniforms viewUniforms(const View& view, const View& previous);

// Of views that are drawn together, at most shared::kMaxViews of one size, of a rig. `sphere`: what they are
// a part of, or null.
shared::FrameUniforms frameUniforms(const SceneOnGpu& scene, const KnobTable& knobs,
                                    const std::vector<View>& views, const std::vector<View>& previousViews,
                                    const std::vector<View>& rig, double time, glm::uvec2 size,
                                    const SpherePart* sphere);

// Pixels of all the sphere that a view is a part of, longitudes and latitudes.
glm::vec2 wholeSphere(const View& view, glm::uvec2 size);
// Pixels that knobs count by as the height of a picture of this size.
float knobHeight(const View& view, glm::uvec2 size, const SpherePart* sphere);

// Fitted colour maps by rule, since a fit costs a tenth of a millisecond or more and most materials share
// them.
class ColorMaps {
 public:
  shared::ColorMap get(const ColorRule& rule);

 private:
  std::vector<std::pair<ColorRule, shared::ColorMap>> known_;
};

// The whole sets of colours that a material has under a look, from the scene or from the look.
struct ChosenSets {
  std::optional<SetTexture> lit, shadowed;
};
ChosenSets chosenSets(const SceneOnGpu& scene, size_t material, const KnobTable& knobs,
                      LookTextures& textures);

// How a picture of so many texels lies behind everything, under a look. `sphere`: pixels of all of that,
// where it goes around; else 0, 0.
shared::Backdrop backdropUniforms(const SceneOnGpu& scene, const KnobTable& knobs,
                                  const shared::FrameUniforms& frame, const glm::uvec2& texels,
                                  const glm::vec2& sphere, ColorMaps& maps);

// How far outside of its silhouette any surface tears edges, in pixels.
float largestInflation(const SceneOnGpu& scene, const KnobTable& knobs, float knobHeight);

// The material's facts, its texture transforms and its colour maps under a look, with the sets of colours
// that the scene has been given for it. `overPicture`: the ground is seen by its shadows only.
shared::MaterialData materialData(const SceneOnGpu& scene, size_t material, const KnobTable& knobs,
                                  bool overPicture, ColorMaps& maps);

}  // namespace scumble::renderer
