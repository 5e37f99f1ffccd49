#include "passes/blur/blur.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "frame/image_step.h"
#include "passes/blur/blur.shared.h"
#include "passes/blur/blur_knobs.h"
#include "passes/final_shadow/final_shadow_knobs.h"
#include "shaders/blur_image_comp.h"
#include "shaders/blur_image_frag.h"

namespace scumble::passes {

using namespace frame;

namespace {

constexpr uint32_t kFraction = 4;  // of the size, in which the blur lies

// A Gaussian ends there, in texels.
int farthestTap(float sigma) {
  return std::min(int(std::ceil(2.0f * sigma)), shared::kMaxBlurTaps / 2 - 1);
}

}  // namespace

BlurPlan planBlur(float radius) {
  // Going to a quarter filters with a standard deviation of two source texels, which is enough against
  // aliasing.
  constexpr float kQuarterSigma = 2.0f;
  const float sigma = 0.5f * radius;
  BlurPlan plan{kQuarterSigma, 0.0f, 1.0f};
  if (sigma > kQuarterSigma)
    plan.fullSigma = std::sqrt(sigma * sigma - kQuarterSigma * kQuarterSigma) / 4;
  else
    plan.amount = sigma / kQuarterSigma;
  return plan;
}

float blurReach(float radius) {
  const BlurPlan plan = planBlur(radius);
  // The texels around a pixel, and what they are made from.
  return 2 * kFraction + float(farthestTap(plan.fullSigma)) * kFraction +
         float(farthestTap(plan.quarterSigma));
}

float depthSharpness(float depthEdge) {
  return depthEdge > 0 ? 0.5f / (depthEdge * depthEdge) : 0.0f;
}

namespace {

// A Gaussian of `sigma` source texels around the centre of an output pixel that spans `factor` of them, and
// its number of taps.
std::pair<shared::BlurStep, uint32_t> makeStep(bool vertical, int factor, float sigma) {
  shared::BlurStep step{};
  step.axis = vertical ? glm::ivec2(0, 1) : glm::ivec2(1, 0);
  step.scale = glm::ivec2(1) + step.axis * (factor - 1);
  step.factor = factor;
  const float center = 0.5f * float(factor - 1);
  const int reach = farthestTap(sigma);
  step.firstTap = int(std::ceil(center)) - reach;
  const int taps = int(std::floor(center)) + reach - step.firstTap + 1;
  for (int i = 0; i < taps; ++i) {
    const float x = float(step.firstTap + i) - center;
    step.weights[i] = sigma > 0 ? std::exp(-0.5f * x * x / (sigma * sigma)) : float(x == 0);
  }
  return {step, uint32_t(taps)};
}

class Blur : public Pass {
 public:
  const char* name() const override { return "blur"; }
  std::span<const Aov> aovs() const override { return kAovs; }

  void declare(FrameBuilder& frame, uint32_t) override {
    isAsked_ = frame.isAsked(kAovs[0]);
    const ImageShader shader{{shaders::blur_image_frag}, {shaders::blur_image_comp}};
    gpu::Handle blurred = frame.get(kShadow);
    for (size_t i = 0; i < steps_.size(); ++i) {
      const std::string part = i + 1 < steps_.size() ? "blur " + std::to_string(i + 1) : "blur";
      const gpu::Handle next =
          frame.image(part, {.format = kHalves, .overX = kFraction, .overY = i == 0 ? 1 : kFraction});
      blurred = steps_[i].declare(
          frame, {.name = name(),
                  .shader = shader,
                  .inputs = {{shared::kBlurSource, blurred}, {shared::kBlurDepth, frame.get(kDepth)}},
                  .tiles = frame.get(kTiles),
                  .outputs = {next},
                  // Eight taps to a quarter, then five; the first step takes depths besides.
                  .fetches = i == 0   ? 17u
                             : i == 1 ? 9u
                                      : 6u,
                  .uniformBytes = sizeof(shared::BlurStep),
                  .constants = {uint32_t(i == 0), 1}})[0];
    }
    frame.give(kBlur, blurred);
    frame.offer(kAovs[0], {blurred});
  }

  void create(FrameBuilder& frame) override {
    for (ImageStep& step : steps_) step.create(frame);
  }
  void bind(const gpu::GraphResources& resources) override {
    for (ImageStep& step : steps_) step.bind(resources);
  }

  void update(const FrameInput& input) override {
    const BlurParams params = input.knobs.scene<BlurParams>();
    const bool everywhere = isAsked_ || !isPlainApartFromEdges(input.knobs.scene<FinalShadowParams>());
    const uint32_t flag = everywhere ? 0 : shared::kTileBlurred;
    const BlurPlan plan = planBlur(params.radius * input.uniforms.pixelScale);
    for (size_t i = 0; i < steps_.size(); ++i) {
      auto [step, taps] =
          makeStep(i % 2 == 1, i < 2 ? int(kFraction) : 1, i < 2 ? plan.quarterSigma : plan.fullSigma);
      step.depthSharpness = depthSharpness(params.depthEdge);
      steps_[i].setJobs({{{uint32_t(i == 0), taps}, {}, {flag, flag}}});
      steps_[i].update(step);
    }
  }

 private:
  // Two channels under coverage; the third one is depth.
  static constexpr Aov kAovs[] = {{.name = "blur", .premultiplied = 2}};

  // To a quarter along x and along y; then blur along x and y.
  std::array<ImageStep, 4> steps_;
  bool isAsked_ = false;
};

}  // namespace

std::unique_ptr<Pass> makeBlur() {
  return std::make_unique<Blur>();
}

}  // namespace scumble::passes
