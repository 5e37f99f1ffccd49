#include "passes/blur/blur.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "frame/image_step.h"
#include "passes/blur/blur.shared.h"
#include "shaders/blur_image_comp.h"
#include "shaders/blur_image_frag.h"

namespace scumble::passes {

using namespace frame;

BlurPlan planBlur(float radius) {
  // A halving filters with a standard deviation of about one source texel, which is enough against aliasing.
  constexpr float kHalving = 1.0f;
  constexpr float kLeastVariance = kHalving * kHalving + 4 * kHalving * kHalving;  // in full-size pixels
  const float sigma = 0.5f * radius, variance = sigma * sigma;
  BlurPlan plan{{kHalving, kHalving}, 0.0f, 1.0f};
  if (variance > kLeastVariance) {
    plan.fullSigma = std::sqrt(variance - kLeastVariance) / 4;
  } else {
    plan.amount = std::sqrt(variance / kLeastVariance);
  }
  return plan;
}

float depthFalloff(float depthEdge) { return depthEdge > 0 ? 0.5f / (depthEdge * depthEdge) : 0.0f; }

namespace {

class Blur : public Pass {
 public:
  const char* name() const override { return "blur"; }

  void declare(FrameBuilder& frame) override {
    const Configuration& c = frame.configuration();
    const uint32_t halfWidth = (c.width + 1) / 2, halfHeight = (c.height + 1) / 2;
    const uint32_t width = (c.width + 3) / 4, height = (c.height + 3) / 4;
    const VkFormat format = slotInfo(Slot::blur).format;
    const auto image = [&](const char* name, uint32_t w, uint32_t h) {
      return frame.transient(name, {format, w, h, c.viewCount});
    };
    const gpu::ResourceId chain[] = {frame.slot(Slot::shadow),
                                     image("blur 1", halfWidth, c.height),
                                     image("blur 2", halfWidth, halfHeight),
                                     image("blur 3", width, halfHeight),
                                     image("blur 4", width, height),
                                     image("blur 5", width, height),
                                     frame.slot(Slot::blur)};
    const ImageShader shader{{shaders::blur_image_frag}, {shaders::blur_image_comp}};
    for (size_t i = 0; i < steps_.size(); ++i)
      steps_[i].declare(frame, "blur", shader, {{chain[i]}, {frame.slot(Slot::depth)}}, chain[i + 1],
                        sizeof(shared::BlurStep));
  }

  void create(FrameBuilder& frame, const FrameResources& resources) override {
    for (ImageStep& step : steps_) step.create(frame, resources);
  }

  void update(const FrameInput& input) override {
    const BlurParams params = input.look.get<BlurParams>();
    const BlurPlan plan = planBlur(params.radius * input.uniforms.pixelScale);
    for (size_t i = 0; i < steps_.size(); ++i) {
      const bool halves = i < 4;
      const float sigma = halves ? plan.halvingSigma[i / 2] : plan.fullSigma;
      shared::BlurStep step{};
      step.vertical = i % 2;
      step.halving = halves;
      step.reach = int(std::ceil(2.5f * sigma));
      step.falloff = sigma > 0 ? 0.5f / (sigma * sigma) : 1.0f;
      step.depthFalloff = depthFalloff(params.depthEdge);
      step.first = i == 0;
      steps_[i].update(step);
    }
  }

 private:
  // Halve along x, y, x, y; then blur along x and y.
  std::array<ImageStep, 6> steps_;
};

}  // namespace

std::unique_ptr<Pass> makeBlur() { return std::make_unique<Blur>(); }

}  // namespace scumble::passes
