#include "passes/bloom/bloom.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "frame/image_step.h"
#include "passes/bloom/bloom.shared.h"
#include "passes/final_color/final_color_knobs.h"
#include "shaders/bloom_image_comp.h"
#include "shaders/bloom_image_frag.h"

namespace scumble::passes {

using namespace frame;

namespace {

constexpr uint32_t kGlowFraction = 4;  // of the size, in which the glow lies

// Where the glow ends, in its texels; at least one.
float reachOf(const FinalColorParams& params, float imageHeight) {
  const float reach = 0.01f * params.bloomReach * imageHeight / float(kGlowFraction);
  return std::clamp(reach, 1.0f, float(shared::kFarthestBloomTap));
}

// Goes to 0 smoothly at `reach`; the weights of both sides add up to 1.
shared::BloomStep makeStep(bool vertical, float reach) {
  shared::BloomStep step{};
  step.axis = vertical ? glm::ivec2(0, 1) : glm::ivec2(1, 0);
  float sum = 0;
  for (int i = 0; i < int(std::size(step.weights)); ++i) {
    const float away = std::min(float(i) / (reach + 0.5f), 1.0f), part = 1 - away * away;
    step.weights[i] = part * part * part * part;
    sum += (i == 0 ? 1.0f : 2.0f) * step.weights[i];
  }
  for (float& weight : step.weights) weight /= sum;
  return step;
}

class Bloom : public Pass {
 public:
  const char* name() const override { return "bloom"; }

  void declare(FrameBuilder& frame, uint32_t) override {
    gpu::Handle glow = frame.get(kShadow);
    for (size_t i = 0; i < steps_.size(); ++i) {
      const std::string part = i + 1 < steps_.size() ? "bloom " + std::to_string(i + 1) : "bloom";
      glow = steps_[i].declare(
          frame, {.name = name(),
                  .shader = {{shaders::bloom_image_frag}, {shaders::bloom_image_comp}},
                  .inputs = {{shared::kBloomSource, glow, i == 0}},
                  .outputs = {frame.image(
                      part, {.format = kHalves, .overX = kGlowFraction, .overY = kGlowFraction})},
                  // Four filtered places; then what the usual reach takes at 1080 lines.
                  .fetches = i == 0 ? 16u : 23u,
                  .uniformBytes = sizeof(shared::BloomStep),
                  .constants = {0}})[0];
    }
    frame.give(kBloom, glow);
  }
  void create(FrameBuilder& frame) override {
    for (ImageStep& step : steps_) step.create(frame);
  }
  void bind(const gpu::GraphResources& resources) override {
    for (ImageStep& step : steps_) step.bind(resources);
  }

  void update(const FrameInput& input) override {
    const float reach = reachOf(input.knobs.scene<FinalColorParams>(), input.uniforms.knobHeight);
    for (size_t i = 0; i < steps_.size(); ++i) {
      steps_[i].setJobs({{{i == 0 ? 0 : uint32_t(std::ceil(reach))}, {}}});
      steps_[i].update(makeStep(i == 2, reach));
    }
  }

 private:
  std::array<ImageStep, 3> steps_;  // to a quarter of the size; along x and y
};

}  // namespace

std::unique_ptr<Pass> makeBloom() {
  return std::make_unique<Bloom>();
}

}  // namespace scumble::passes
