#include "passes/color/color.h"

#include <algorithm>
#include <cmath>

#include "frame/image_step.h"
#include "passes/color/color.shared.h"
#include "shaders/color_image_comp.h"
#include "shaders/color_image_frag.h"
#include "stage/palette.h"

namespace scumble::passes {

using namespace frame;

namespace {

class Color : public Pass {
 public:
  Color(Layer layer, ShadowMixOf shadowMix) : layer_(layer), shadowMix_(shadowMix) {}
  const char* name() const override { return layer_ == Layer::first ? "color" : "behind"; }
  std::span<const Aov> aovs() const override { return kAovs; }

  void declare(FrameBuilder& frame, uint32_t) override {
    const gpu::Handle picture =
        step_.declare(frame, name(), {{shaders::color_image_frag}, {shaders::color_image_comp}},
                      {{frame.get(kLight, layer_)},
                       {frame.get(kLit, layer_)},
                       {frame.get(kShadowed, layer_)},
                       {frame.get(kDepth, layer_)}},
                      {frame.image(name(), {.format = kHalves})}, sizeof(shared::ColorUniforms))[0];
    frame.give(kPicture, picture, layer_);
    if (layer_ == Layer::first) frame.offer(kAovs[0], {picture});
  }
  void create(FrameBuilder& frame) override { step_.create(frame); }
  void bind(const gpu::GraphResources& resources) override { step_.bind(resources); }

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
    const float center = glm::length(input.uniforms.sceneCenter - input.uniforms.viewer);
    uniforms.airStart = center + params.airStart * radius;
    uniforms.airEnd = center + std::max(params.airEnd, params.airStart + 1e-3f) * radius;
    uniforms.transparent = input.transparent;
    const ShadowMix shadowMix = shadowMix_(input.look);
    uniforms.glowColor = shadowMix.glowColor;
    // What lies behind has light without a blur, and no glow.
    uniforms.glowColorAmount = layer_ == Layer::first ? shadowMix.glowColorAmount : 0;
    uniforms.mixesValues = shadowMix.mixesValues;
    step_.update(uniforms);
  }

 private:
  static constexpr Aov kAovs[] = {{.name = "color", .isColor = true, .premultiplied = 3}};

  Layer layer_;
  ShadowMixOf shadowMix_;
  ImageStep step_;
};

}  // namespace

std::unique_ptr<Pass> makeColor(Layer layer, ShadowMixOf shadowMix) {
  return std::make_unique<Color>(layer, shadowMix);
}

}  // namespace scumble::passes
