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
  explicit FinalShadow(BlurAmount blurAmount) : blurAmount_(blurAmount) {}
  const char* name() const override { return "final-shadow"; }

  void declare(FrameBuilder& frame) override {
    step_.declare(frame, "final-shadow", {{shaders::final_shadow_image_frag}, {shaders::final_shadow_image_comp}},
                  {{frame.slot(Slot::blur), true}, {frame.slot(Slot::shadow)}}, frame.slot(Slot::finalShadow),
                  sizeof(shared::FinalShadowUniforms));
  }
  void create(FrameBuilder& frame, const FrameResources& resources) override { step_.create(frame, resources); }

  void update(const FrameInput& input) override {
    const FinalShadowParams params = input.look.get<FinalShadowParams>();
    shared::FinalShadowUniforms uniforms{};
    uniforms.threshold = params.threshold;
    uniforms.softness = params.softness;
    uniforms.innerGlow = params.innerGlow;
    uniforms.indication = params.indication;
    uniforms.indicationSteps = params.indicationSteps;
    uniforms.blurAmount = blurAmount_(input.look, input.uniforms.pixelScale);
    step_.update(uniforms);
  }

 private:
  BlurAmount blurAmount_;
  ImageStep step_;
};

}  // namespace

std::unique_ptr<Pass> makeFinalShadow(BlurAmount blurAmount) { return std::make_unique<FinalShadow>(blurAmount); }

}  // namespace scumble::passes
