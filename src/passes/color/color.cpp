#include "passes/color/color.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "frame/image_step.h"
#include "frame/palette.h"
#include "passes/color/color.shared.h"
#include "shaders/color_image_comp.h"
#include "shaders/color_image_frag.h"

namespace scumble::passes {

using namespace frame;

namespace {

class Color : public Pass {
 public:
  explicit Color(ShadowMixOf shadowMix) : shadowMix_(shadowMix) {}
  const char* name() const override { return "color"; }

  void declare(FrameBuilder& frame) override {
    viewCount_ = frame.configuration().viewCount;
    const auto mix = [&](const char* step, Slot light, Slot lit, Slot shadowed, Slot depth, Slot color) {
      steps_.emplace_back().declare(
          frame, step, {{shaders::color_image_frag}, {shaders::color_image_comp}},
          {{frame.slot(light)}, {frame.slot(lit)}, {frame.slot(shadowed)}, {frame.slot(depth)}},
          frame.slot(color), sizeof(shared::ColorUniforms));
    };
    mix("color", Slot::finalShadow, Slot::lit, Slot::shadowed, Slot::depth, Slot::color);
    if (frame.configuration().layered)
      mix("behind", Slot::behindShadow, Slot::behindLit, Slot::behindShadowed, Slot::behindDepth,
          Slot::behind);
  }
  void create(FrameBuilder& frame, const FrameResources& resources) override {
    viewCount_ = frame.configuration().viewCount;
    for (ImageStep& step : steps_) step.create(frame, resources);
  }

  void update(const FrameInput& input) override {
    const BackgroundParams params = input.look.get<BackgroundParams>();
    shared::ColorUniforms uniforms{};
    uniforms.horizon = params.horizon;
    uniforms.zenith = params.zenith;
    if (params.mode == 0) {
      const BackgroundColors colors = automaticBackground(input.scene.colors());
      uniforms.horizon = colors.horizon;
      uniforms.zenith = colors.zenith;
    }
    uniforms.height = std::sin(glm::radians(params.height));
    uniforms.air = params.air;
    const float radius = input.uniforms.sceneRadius;
    // From the middle of all eyes, so that the air is the same in each.
    glm::vec3 viewer(0.0f);
    for (uint32_t v = 0; v < viewCount_; ++v) viewer += input.uniforms.views[v].eye / float(viewCount_);
    const float center = glm::length(input.uniforms.sceneCenter - viewer);
    uniforms.airStart = center + params.airStart * radius;
    uniforms.airEnd = center + std::max(params.airEnd, params.airStart + 1e-3f) * radius;
    uniforms.transparent = input.transparent;
    const ShadowMix shadowMix = shadowMix_(input.look);
    uniforms.glowColor = shadowMix.glowColor;
    uniforms.glowColorAmount = shadowMix.glowColorAmount;
    uniforms.mixesValues = shadowMix.mixesValues;
    for (ImageStep& step : steps_) {
      step.update(uniforms);
      // What lies behind has light without a blur, and no glow.
      uniforms.glowColorAmount = 0;
    }
  }

 private:
  ShadowMixOf shadowMix_;
  uint32_t viewCount_ = 1;
  std::deque<ImageStep> steps_;  // they are referred to, and stay where they are
};

}  // namespace

std::unique_ptr<Pass> makeColor(ShadowMixOf shadowMix) {
  return std::make_unique<Color>(shadowMix);
}

}  // namespace scumble::passes
