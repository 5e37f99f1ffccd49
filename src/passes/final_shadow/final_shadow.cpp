#include "passes/final_shadow/final_shadow.h"

#include "frame/image_step.h"
#include "passes/final_shadow/final_shadow.shared.h"
#include "shaders/final_shadow_image_comp.h"
#include "shaders/final_shadow_image_frag.h"

namespace scumble::passes {

using namespace frame;

namespace {

class FinalShadow : public Pass {
 public:
  explicit FinalShadow(BlurFactsOf blurFacts) : blurFacts_(blurFacts) {}
  const char* name() const override { return "final-shadow"; }

  void declare(FrameBuilder& frame) override {
    step_.declare(frame, "final-shadow",
                  {{shaders::final_shadow_image_frag}, {shaders::final_shadow_image_comp}},
                  {{frame.slot(Slot::blur)},
                   {frame.slot(Slot::shadow)},
                   {frame.slot(Slot::depth)},
                   {frame.slot(Slot::warp)}},
                  frame.slot(Slot::finalShadow), sizeof(shared::FinalShadowUniforms));
  }
  void create(FrameBuilder& frame, const FrameResources& resources) override {
    step_.create(frame, resources);
  }

  void update(const FrameInput& input) override {
    const FinalShadowParams params = input.look.get<FinalShadowParams>();
    shared::FinalShadowUniforms uniforms{};
    uniforms.threshold = params.threshold;
    uniforms.softness = params.softness;
    uniforms.innerGlow = params.innerGlow;
    uniforms.indication = params.indication;
    uniforms.dither = params.dither;
    uniforms.indicationSteps = params.indicationSteps;
    const BlurFacts blur = blurFacts_(input.look, input.uniforms.pixelScale);
    uniforms.blurAmount = blur.amount;
    uniforms.depthSharpness = blur.depthSharpness;
    step_.update(uniforms);
  }

 private:
  BlurFactsOf blurFacts_;
  ImageStep step_;
};

}  // namespace

std::unique_ptr<Pass> makeFinalShadow(BlurFactsOf blurFacts) {
  return std::make_unique<FinalShadow>(blurFacts);
}

}  // namespace scumble::passes
