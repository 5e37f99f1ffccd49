// Lays ink over the picture.
#include "features/ink/ink.h"
#include "features/ink/ink.shared.h"
#include "features/ink/ink_knobs.h"
#include "features/ink/over/over_lines.h"
#include "frame/image_step.h"
#include "passes/warp/warp_knobs.h"
#include "shaders/ink_over_image_comp.h"
#include "shaders/ink_over_image_frag.h"

namespace scumble::ink {

using namespace frame;

namespace {

class Over : public Pass {
 public:
  const char* name() const override { return "ink-over"; }
  uint32_t variant(const scene::SceneData& scene, const look::LookData& look) const override {
    if (!mayShow(look)) return 0;
    return 1 + 2 * passes::mayTear(look) + 4 * mayShowShadows(look) + 8 * mayShowPieces(scene, look);
  }

  void declare(FrameBuilder& frame, uint32_t variant) override {
    if (!variant) return;
    tears_ = variant & 2;
    ends_ = frame.has(kPaintedExtent);
    isOverlay_ = frame.has(kOverlay, Layer::lines);
    const bool shadows = !isOverlay_ && variant & 4;
    pieces_ = !isOverlay_ && variant & 8;
    const gpu::Handle ink = isOverlay_ ? frame.get(kOverlay, Layer::lines) : frame.get(kStrokes);
    frame.give(
        kPicture,
        step_.declare(frame, {.name = name(),
                              .shader = {{shaders::ink_over_image_frag}, {shaders::ink_over_image_comp}},
                              .inputs = {{shared::kInkOverPicture, frame.get(kPicture)},
                                         {shared::kInkOverStrokes, ink, true},
                                         {shared::kInkOverWarp, frame.get(tears_ ? kWarp : kLit)},
                                         {shared::kInkOverTiles, frame.get(kTiles)},
                                         {shared::kInkOverLight, frame.get(shadows ? kLight : kLit), true},
                                         {shared::kInkOverDepth, frame.get(kDepth)},
                                         {shared::kInkOverPieces, frame.get(pieces_ ? kPieces : kLit)},
                                         {shared::kInkOverExtent, frame.get(ends_ ? kPaintedExtent : kLit)}},
                              .outputs = {frame.image(name(), {.format = kHalves})},
                              .fetches = 1 + 4 + 1 + 2 + ends_ + fetchesOfFoundLines(shadows, pieces_),
                              .uniformBytes = sizeof(shared::InkOverUniforms)})[0]);
  }
  void create(FrameBuilder& frame) override { step_.create(frame); }
  void bind(const gpu::GraphResources& resources) override { step_.bind(resources); }
  void update(const FrameInput& input) override {
    const FoundLines found = foundLines(input, pieces_);
    const uint32_t options = (tears_ ? shared::kInkOverTears : 0) |
                             (isOverlay_ ? shared::kInkOverIsOverlay : 0) |
                             (ends_ ? shared::kInkOverEnds : 0);
    step_.setJobs({{{options, found.inMetres, isOverlay_ ? 0 : found.lines}, {}}});
    step_.update(found.uniforms);
  }

 private:
  ImageStep step_;
  bool tears_ = false, ends_ = false, isOverlay_ = false, pieces_ = false;
};

}  // namespace

std::unique_ptr<Pass> makeOver() {
  return std::make_unique<Over>();
}

}  // namespace scumble::ink
