#include "passes/colorize/colorize.h"

#include <deque>

#include "frame/image_step.h"
#include "passes/colorize/strips.h"
#include "shaders/colorize_image_comp.h"
#include "shaders/colorize_image_frag.h"

namespace scumble::passes {

using namespace frame;

namespace {

class Colorize : public Pass {
 public:
  const char* name() const override { return "colorize"; }

  void declare(FrameBuilder& frame) override {
    const Configuration& configuration = frame.configuration();
    width_ = configuration.width, height_ = configuration.height, viewCount_ = configuration.viewCount;
    const auto add = [&](const char* step, Slot color, Slot depth, Slot output) {
      steps_.emplace_back().declare(
          frame, step, {{shaders::colorize_image_frag}, {shaders::colorize_image_comp}},
          {{frame.slot(color)}, {frame.slot(depth)}}, frame.slot(output), sizeof(shared::ColorizeUniforms));
    };
    add("colorize", Slot::color, Slot::depth, Slot::colorize);
    if (configuration.layered) add("behind-colorize", Slot::behind, Slot::behindDepth, Slot::behindColorize);
  }
  void create(FrameBuilder& frame, const FrameResources& resources) override {
    for (ImageStep& step : steps_) step.create(frame, resources);
  }

  void update(const FrameInput& input) override {
    const std::vector<PlacedColorizer> colorizers =
        placeColorizers(input.look, input.scene.data(), input.scene.motion().worldAsDrawn(), input.uniforms);
    shared::ColorizeUniforms uniforms{};
    const uint32_t features = fillUniforms(colorizers, input.uniforms, viewCount_, width_, height_, uniforms);
    for (ImageStep& step : steps_) {
      step.setJobs({{{features}, {}}});
      step.update(uniforms);
    }
  }

 private:
  std::deque<ImageStep> steps_;  // they are referred to, and stay where they are
  uint32_t width_ = 0, height_ = 0, viewCount_ = 1;
};

}  // namespace

std::unique_ptr<Pass> makeColorize() {
  return std::make_unique<Colorize>();
}

}  // namespace scumble::passes
