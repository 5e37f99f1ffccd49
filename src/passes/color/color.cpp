#include "passes/color/color.h"

#include <algorithm>
#include <cmath>

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
  const char* name() const override { return "color"; }

  void declare(FrameBuilder& frame) override {
    step_.declare(frame, "color", {{shaders::color_image_frag}, {shaders::color_image_comp}},
                  {{frame.slot(Slot::finalShadow)},
                   {frame.slot(Slot::lit)},
                   {frame.slot(Slot::shadowed)},
                   {frame.slot(Slot::depth)}},
                  frame.slot(Slot::color), sizeof(shared::ColorUniforms));
  }
  void create(FrameBuilder& frame, const FrameResources& resources) override {
    step_.create(frame, resources);
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
    const float center = glm::length(input.uniforms.sceneCenter - input.uniforms.views[0].eye);
    uniforms.airStart = center + params.airStart * radius;
    uniforms.airEnd = center + std::max(params.airEnd, params.airStart + 1e-3f) * radius;
    uniforms.transparent = input.transparent;
    step_.update(uniforms);
  }

 private:
  ImageStep step_;
};

}  // namespace

std::unique_ptr<Pass> makeColor() {
  return std::make_unique<Color>();
}

}  // namespace scumble::passes
