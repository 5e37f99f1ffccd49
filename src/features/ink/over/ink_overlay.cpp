// Ink as an overlay of the picture, which other passes change the colours of.
#include "features/ink/ink.h"
#include "features/ink/ink_knobs.h"
#include "features/ink/over/over_lines.h"
#include "frame/image_step.h"
#include "passes/colorize/colorize_knobs.h"
#include "passes/limit/limit_knobs.h"
#include "shaders/ink_overlay_image_comp.h"
#include "shaders/ink_overlay_image_frag.h"

namespace scumble::ink {

using namespace frame;

namespace {

class Overlay : public Pass {
 public:
  const char* name() const override { return "ink-overlay"; }
  uint32_t variant(const scene::SceneData& scene, const look::LookData& look) const override {
    const bool isGraded = passes::changesOverlays(look, scene);
    if (!mayShow(look) || !(isGraded || !passes::paletteColors(look.get<passes::LimitParams>()).empty()))
      return 0;
    return 1 + 2 * uint32_t(isGraded) + 4 * mayShowShadows(look) + 8 * mayShowPieces(scene, look);
  }

  void declare(FrameBuilder& frame, uint32_t variant) override {
    if (!variant) return;
    const bool isGraded = variant & 2, shadows = variant & 4;
    pieces_ = variant & 8;
    const std::vector<gpu::Handle> made = step_.declare(
        frame, {.name = name(),
                .shader = {{shaders::ink_overlay_image_frag}, {shaders::ink_overlay_image_comp}},
                .inputs = {{shared::kInkOverlayStrokes, frame.get(kStrokes)},
                           {shared::kInkOverlayTiles, frame.get(kTiles)},
                           {shared::kInkOverlayLight, frame.get(shadows ? kLight : kLit), true},
                           {shared::kInkOverlayDepth, frame.get(kDepth)},
                           {shared::kInkOverlayPieces, frame.get(pieces_ ? kPieces : kLit)},
                           {shared::kInkOverlayNearness, frame.get(isGraded ? kStrokesNearness : kLit)}},
                .outputs = {frame.image(name(), {.format = kHalves}),
                            frame.image("distance of ink", {.format = kHalves})},
                .fetches = 4 + fetchesOfFoundLines(shadows, pieces_),
                .uniformBytes = sizeof(shared::InkOverUniforms)});
    frame.give(kOverlay, made[0], Layer::lines);
    if (isGraded) frame.give(kOverlayDistance, made[1], Layer::lines);
  }
  void create(FrameBuilder& frame) override { step_.create(frame); }
  void bind(const gpu::GraphResources& resources) override { step_.bind(resources); }
  void update(const FrameInput& input) override {
    const FoundLines found = foundLines(input, pieces_);
    step_.setJobs({{{0, found.inMetres, found.lines}, {}}});
    step_.update(found.uniforms);
  }

 private:
  ImageStep step_;
  bool pieces_ = false;
};

}  // namespace

std::unique_ptr<Pass> makeOverlay() {
  return std::make_unique<Overlay>();
}

}  // namespace scumble::ink
