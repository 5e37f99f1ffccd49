#include "passes/final_shadow/final_shadow.h"

#include <algorithm>
#include <cmath>

#include "frame/image_step.h"
#include "passes/blur/blur_knobs.h"
#include "passes/final_shadow/final_shadow.shared.h"
#include "passes/final_shadow/final_shadow_knobs.h"
#include "shaders/final_shadow_image_comp.h"
#include "shaders/final_shadow_image_frag.h"
#include "shaders/final_shadow_samples_image_comp.h"
#include "shaders/final_shadow_samples_image_frag.h"

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

float deepGlow(const FinalShadowParams& params) {
  const float reach = glowReach(params.glowWidth, stepThresholds(params).darkest);
  return std::round(255 * params.innerGlow * std::min(1 / reach, 1.0f)) / 255;
}

namespace {

class FinalShadow : public Pass {
 public:
  const char* name() const override { return "final-shadow"; }
  std::span<const Aov> aovs() const override { return kAovs; }

  uint32_t variant(const scene::SceneData&, const look::LookData& look) const override {
    return (shadesByMarks(look.get<FinalShadowParams>()) ? kMarks : 0) |
           (look.get<BlurParams>().radius > 0 ? kBlurs : 0);
  }

  void declare(FrameBuilder& frame, uint32_t variant) override {
    variant_ = variant;
    // Anything stands for what is not looked at.
    const auto only = [&](uint32_t part, const Role& role) {
      return frame.get(variant & part ? role : kShadow);
    };
    ImageStepDesc desc{.name = name(),
                       .shader = {{shaders::final_shadow_image_frag}, {shaders::final_shadow_image_comp}},
                       .inputs = {{shared::kFinalShadowBlurred, only(kBlurs, kBlur)},
                                  {shared::kFinalShadowShadow, frame.get(kShadow)},
                                  {shared::kFinalShadowDepth, frame.get(kDepth)},
                                  {shared::kFinalShadowWarp, only(kMarks, kWarp)}},
                       .tiles = frame.get(kTiles),
                       .outputs = {frame.image(name(), {.format = kBytes})},
                       .fetches = 3 + 4,
                       .uniformBytes = sizeof(shared::FinalShadowUniforms),
                       .maxJobs = 3};
    hasSamples_ = frame.configuration().samples > 1;
    if (hasSamples_) {
      desc.shader = {{shaders::final_shadow_samples_image_frag}, {shaders::final_shadow_samples_image_comp}};
      desc.inputs.push_back({shared::kFinalShadowSamples, frame.get(kShadowSamples)});
      desc.inputs.push_back({shared::kFinalShadowDepthSamples, frame.get(kDepthSamples)});
      desc.outputs.push_back(frame.image("sample light", {.format = kBytes}));
      desc.fetches += 4 + 4;
    }
    const std::vector<gpu::Handle> light = step_.declare(frame, std::move(desc));
    isAsked_ = frame.isAsked(kAovs[0]);
    frame.give(kLight, light[0]);
    if (hasSamples_) frame.give(kSampleLight, light[1]);
    frame.offer(kAovs[0], {light[0]});
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
    uniforms.glowReach = glowReach(params.glowWidth, steps.darkest);
    const BlurParams blur = input.knobs.scene<BlurParams>();
    uniforms.blurAmount = planBlur(blur.radius * input.uniforms.pixelScale).amount;
    uniforms.depthSharpness = depthSharpness(blur.depthEdge);
    using namespace shared;
    const uint32_t light = (variant_ & kBlurs ? kLightBlurred : 0) |
                           (uniforms.blurAmount < 1 ? kLightSharp : 0) |
                           (variant_ & kMarks ? kLightMarks : 0);
    const uint32_t indications = uint32_t(params.indicationSteps);
    std::vector<ImageStep::Job> jobs;
    uint32_t shaded = 0;
    if (isPlainApartFromEdges(params)) {
      // Plain tiles are read by nobody, unless there is a picture behind everything to lie in the shadow.
      const uint32_t read = input.backdrop || isAsked_ ? 0 : kTilePlain;
      jobs = {{{indications, 0, light}, {}, {kTileShaded | read, 0}}};
      shaded = kTileShaded;
    }
    const uint32_t mixed = hasSamples_ ? kTileMixed : 0;
    jobs.push_back({{indications, 1, light}, {}, {shaded | mixed, shaded}});
    if (hasSamples_)
      jobs.push_back({{indications, 1, light | kLightSeveral}, {}, {shaded | mixed, shaded | mixed}});
    step_.setJobs(jobs);
    for (size_t job = 0; job < jobs.size(); ++job) step_.update(uniforms, job);
  }

 private:
  static constexpr uint32_t kMarks = 1, kBlurs = 2;  // variants
  static constexpr Aov kAovs[] = {{.name = "final-shadow"}};

  ImageStep step_;
  uint32_t variant_ = 0;
  bool isAsked_ = false, hasSamples_ = false;
};

}  // namespace

std::unique_ptr<Pass> makeFinalShadow() {
  return std::make_unique<FinalShadow>();
}

}  // namespace scumble::passes
