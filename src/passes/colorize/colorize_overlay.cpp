// Grades an overlay of the picture as `colorize` grades surfaces, at its own distance.
#include "frame/image_step.h"
#include "passes/colorize/colorize.h"
#include "passes/colorize/colorize_knobs.h"
#include "passes/colorize/strips.h"
#include "shaders/colorize_overlay_image_comp.h"
#include "shaders/colorize_overlay_image_frag.h"

namespace scumble::passes {

using namespace frame;

namespace {

class ColorizeOverlay : public Pass {
 public:
  explicit ColorizeOverlay(Layer layer) : layer_(layer) {}
  const char* name() const override { return layer_ == Layer::paint ? "colorize-paint" : "colorize-lines"; }

  void declare(FrameBuilder& frame, uint32_t) override {
    if (!frame.has(kOverlayDistance, layer_)) return;
    viewCount_ = frame.configuration().viewCount;
    frame.give(
        kOverlay,
        step_.declare(frame, {.name = name(),
                              .shader = {{shaders::colorize_overlay_image_frag},
                                         {shaders::colorize_overlay_image_comp}},
                              .inputs = {{shared::kColorizeColor, frame.get(kOverlay, layer_)},
                                         {shared::kColorizeDepth, frame.get(kOverlayDistance, layer_)}},
                              .outputs = {frame.image(name(), {.format = kHalves})},
                              .fetches = 2,
                              .uniformBytes = sizeof(shared::ColorizeUniforms)})[0],
        layer_);
  }
  void create(FrameBuilder& frame) override { step_.create(frame); }
  void bind(const gpu::GraphResources& resources) override { step_.bind(resources); }

  void update(const FrameInput& input) override {
    shared::ColorizeUniforms uniforms{};
    const uint32_t features = fillUniforms(input, viewCount_, uniforms);
    step_.setJobs({{{features}, {}}});
    step_.update(uniforms);
  }

 private:
  Layer layer_;
  ImageStep step_;
  uint32_t viewCount_ = 1;
};

}  // namespace

std::unique_ptr<Pass> makeColorizeOverlay(Layer layer) {
  return std::make_unique<ColorizeOverlay>(layer);
}

}  // namespace scumble::passes
