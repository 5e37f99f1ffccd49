// An overlay of the picture in few colours.
#include "frame/image_step.h"
#include "passes/limit/limit.h"
#include "passes/limit/limit.shared.h"
#include "passes/limit/limit_knobs.h"
#include "shaders/limit_overlay_image_comp.h"
#include "shaders/limit_overlay_image_frag.h"

namespace scumble::passes {

using namespace frame;

namespace {

class LimitOverlay : public Pass {
 public:
  explicit LimitOverlay(Layer layer) : layer_(layer) {}
  const char* name() const override { return layer_ == Layer::paint ? "limit-paint" : "limit-lines"; }
  uint32_t variant(const scene::SceneData&, const look::LookData& look) const override {
    return !paletteColors(look.get<LimitParams>()).empty();
  }

  void declare(FrameBuilder& frame, uint32_t isLimited) override {
    if (!isLimited || !frame.has(kOverlay, layer_)) return;
    frame.give(kOverlay,
               step_.declare(frame, {.name = name(),
                                     .shader = {{shaders::limit_overlay_image_frag},
                                                {shaders::limit_overlay_image_comp}},
                                     .inputs = {{shared::kLimitOverlay, frame.get(kOverlay, layer_)}},
                                     .outputs = {frame.image(name(), {.format = kHalves})},
                                     .fetches = 1,
                                     .uniformBytes = sizeof(shared::LimitOverlayUniforms)})[0],
               layer_);
  }
  void create(FrameBuilder& frame) override { step_.create(frame); }
  void bind(const gpu::GraphResources& resources) override { step_.bind(resources); }

  void update(const FrameInput& input) override {
    const LimitParams params = input.knobs.scene<LimitParams>();
    shared::LimitOverlayUniforms uniforms{params.amount, params.lightness, {}};
    const uint32_t count = writePalette(params, uniforms.colors);
    step_.setJobs({{{count, uint32_t(layer_ == Layer::paint)}, {}}});
    step_.update(uniforms);
  }

 private:
  Layer layer_;
  ImageStep step_;
};

}  // namespace

std::unique_ptr<Pass> makeLimitOverlay(Layer layer) {
  return std::make_unique<LimitOverlay>(layer);
}

}  // namespace scumble::passes
