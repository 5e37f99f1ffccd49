#include "passes/final_shadow/final_shadow.h"

#include <algorithm>
#include <cmath>

#include "frame/image_step.h"
#include "passes/blur/blur_knobs.h"
#include "passes/final_shadow/final_shadow.shared.h"
#include "passes/final_shadow/final_shadow_knobs.h"
#include "shaders/final_shadow_image_comp.h"
#include "shaders/final_shadow_image_frag.h"

namespace scumble::passes {

using namespace frame;

StepThresholds stepThresholds(const FinalShadowParams& params) {
  constexpr float kLeast = 0.02f, kMost = 0.98f;  // beyond them there would be no light, or no shadow
  StepThresholds result;
  result.spacing = params.stepSpacing;
  const float room = std::max(std::min(params.threshold - kLeast, kMost - params.threshold), 0.0f);
  if (params.steps > 1) result.spacing = std::min(result.spacing, 2 * room / float(params.steps - 1));
  result.darkest = params.threshold - 0.5f * result.spacing * float(params.steps - 1);
  return result;
}

float glowReach(float width, float begin) {
  if (width >= 1) return 1;
  // The blurred light beside a straight edge, over the distance in standard deviations; the blur ends at two.
  constexpr float kEnd = 2;
  const auto normal = [](float x) { return 0.5f * std::erfc(-x / std::sqrt(2.0f)); };
  const auto light = [&](float x) { return (normal(x) - normal(-kEnd)) / (normal(kEnd) - normal(-kEnd)); };
  float low = -kEnd, high = kEnd;
  for (int i = 0; i < 30; ++i) {
    const float middle = 0.5f * (low + high);
    (light(middle) < begin ? low : high) = middle;
  }
  return std::max(1 - light(low - width * (low + kEnd)) / begin, 1e-3f);
}

namespace {

class FinalShadow : public Pass {
 public:
  const char* name() const override { return "final-shadow"; }
  std::span<const Aov> aovs() const override { return kAovs; }

  void declare(FrameBuilder& frame, uint32_t) override {
    const gpu::Handle light = step_.declare(
        frame, {.name = name(),
                .shader = {{shaders::final_shadow_image_frag}, {shaders::final_shadow_image_comp}},
                .inputs = {{shared::kFinalShadowBlurred, frame.get(kBlur)},
                           {shared::kFinalShadowShadow, frame.get(kShadow)},
                           {shared::kFinalShadowDepth, frame.get(kDepth)},
                           {shared::kFinalShadowWarp, frame.get(kWarp)}},
                .outputs = {frame.image(name(), {.format = kBytes})},
                .uniformBytes = sizeof(shared::FinalShadowUniforms)})[0];
    frame.give(kLight, light);
    frame.offer(kAovs[0], {light});
  }
  void create(FrameBuilder& frame) override { step_.create(frame); }
  void bind(const gpu::GraphResources& resources) override { step_.bind(resources); }

  void update(const FrameInput& input) override {
    const FinalShadowParams params = input.knobs.scene<FinalShadowParams>();
    shared::FinalShadowUniforms uniforms{};
    uniforms.knobs = params;
    const StepThresholds steps = stepThresholds(params);
    uniforms.stepThresholds = glm::vec4(params.threshold);
    for (int i = 0; i < params.steps; ++i) {
      uniforms.stepThresholds[i] = steps.darkest + steps.spacing * float(i);
      uniforms.stepShares[i] = 1.0f / float(params.steps);
    }
    uniforms.darkestEdge = steps.darkest;
    uniforms.brightestEdge = uniforms.stepThresholds[params.steps - 1];
    uniforms.glowReach = glowReach(params.glowWidth, steps.darkest);
    step_.setJobs({{{uint32_t(params.indicationSteps)}, {}}});
    const BlurParams blur = input.knobs.scene<BlurParams>();
    uniforms.blurAmount = planBlur(blur.radius * input.uniforms.pixelScale).amount;
    uniforms.depthSharpness = depthSharpness(blur.depthEdge);
    step_.update(uniforms);
  }

 private:
  static constexpr Aov kAovs[] = {{.name = "final-shadow"}};

  ImageStep step_;
};

}  // namespace

std::unique_ptr<Pass> makeFinalShadow() {
  return std::make_unique<FinalShadow>();
}

}  // namespace scumble::passes
