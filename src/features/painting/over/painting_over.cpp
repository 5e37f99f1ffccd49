// Lays strokes over the picture.
#include "features/painting/over/painting_over.shared.h"
#include "features/painting/painting.h"
#include "features/painting/painting_knobs.h"
#include "frame/image_step.h"
#include "passes/warp/warp_knobs.h"
#include "shaders/painting_over_image_comp.h"
#include "shaders/painting_over_image_frag.h"

namespace scumble::painting {

using namespace frame;

namespace {

class Over : public Pass {
 public:
  const char* name() const override { return "painting-over"; }
  uint32_t variant(const scene::SceneData& scene, const look::LookData& look) const override {
    const bool tears = passes::mayTear(look) && look.get<PaintingParams>().warp > 0;
    return drawnPaintings(scene, look) || showsLayers(scene, look) ? 1 + uint32_t(tears) : 0;
  }
  void declare(FrameBuilder& frame, uint32_t variant) override {
    if (!variant) return;
    const bool tears = variant > 1;
    frame.give(
        kPicture,
        step_.declare(frame,
                      {.name = name(),
                       .shader = {{shaders::painting_over_image_frag}, {shaders::painting_over_image_comp}},
                       .inputs = {{shared::kPaintingOverPicture, frame.get(kPicture)},
                                  {shared::kPaintingOverPaint, frame.get(kOverlay, Layer::paint), true},
                                  {shared::kPaintingOverWarp, frame.get(tears ? kWarp : kLit)},
                                  {shared::kPaintingOverTiles, frame.get(kTiles)}},
                       .outputs = {frame.image(name(), {.format = kHalves})},
                       .fetches = 1 + 4 + 1 + 1,
                       .uniformBytes = sizeof(shared::PaintingOverUniforms),
                       .constants = {tears}})[0]);
  }
  void create(FrameBuilder& frame) override { step_.create(frame); }
  void bind(const gpu::GraphResources& resources) override { step_.bind(resources); }
  void update(const FrameInput& input) override {
    step_.update(shared::PaintingOverUniforms{input.knobs.scene<PaintingParams>().warp});
  }

 private:
  ImageStep step_;
};

}  // namespace

std::unique_ptr<Pass> makeOver() {
  return std::make_unique<Over>();
}

}  // namespace scumble::painting
