// Lays ink over the picture.
#include <algorithm>
#include <cmath>

#include "features/ink/ink.h"
#include "features/ink/ink.shared.h"
#include "features/ink/ink_knobs.h"
#include "features/ink/over/over_lines.h"
#include "frame/image_step.h"
#include "passes/final_shadow/final_shadow_knobs.h"
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
    ends_ = frame.has(kPaintedExtent);
    tears_ = variant & 2, shadows_ = variant & 4, pieces_ = variant & 8;
    frame.give(
        kPicture,
        step_.declare(frame, {.name = name(),
                              .shader = {{shaders::ink_over_image_frag}, {shaders::ink_over_image_comp}},
                              .inputs = {{shared::kInkOverPicture, frame.get(kPicture)},
                                         {shared::kInkOverStrokes, frame.get(kStrokes), true},
                                         {shared::kInkOverWarp, frame.get(tears_ ? kWarp : kLit)},
                                         {shared::kInkOverTiles, frame.get(kTiles)},
                                         {shared::kInkOverLight, frame.get(shadows_ ? kLight : kLit), true},
                                         {shared::kInkOverDepth, frame.get(kDepth)},
                                         {shared::kInkOverPieces, frame.get(pieces_ ? kPieces : kLit)},
                                         {shared::kInkOverExtent, frame.get(ends_ ? kPaintedExtent : kLit)}},
                              .outputs = {frame.image(name(), {.format = kHalves})},
                              .fetches = 1 + 4 + 1 + 2 + ends_ + (shadows_ ? 2 * 9 * 5u : 0) +
                                         (pieces_ ? 1 + 12 + kSquare * kSquare : 0),
                              .uniformBytes = sizeof(shared::InkOverUniforms)})[0]);
  }
  void create(FrameBuilder& frame) override { step_.create(frame); }
  void bind(const gpu::GraphResources& resources) override { step_.bind(resources); }
  void update(const FrameInput& input) override {
    const float pixelsOfOne =
        0.5f * input.uniforms.imageSize.y / std::abs(input.uniforms.views[0].ndcToEyeRay.y);
    const float scale = pixelsOfUnit(input.look, pixelsOfOne, input.uniforms.pixelScale);
    const InkParams params = input.knobs.scene<InkParams>();
    const bool inMetres = params.unit == shared::kInkMetres;
    shared::InkOverUniforms u{params.warp, float(input.knobs.scene<passes::FinalShadowParams>().steps)};
    uint32_t shown = 0;
    const auto lines = overLines(input.look);
    for (size_t kind = 0; kind < lines.size(); ++kind) {
      u.kinds[kind] = {scale * lines[kind].radius, lines[kind].color};
      shown |= uint32_t(lines[kind].isShown) << kind;
    }
    // Only as far as the widest line needs; in metres that depends on the distance.
    float widest = 0;
    for (int kind = shared::kInkOverObjects; kind < shared::kInkOverKinds; ++kind)
      if (shown >> kind & 1) widest = std::max(widest, inMetres ? 1e9f : u.kinds[kind].radius + 0.5f);
    const uint32_t reach = pieces_ ? uint32_t(std::min(std::ceil(widest), float(shared::kInkOverReach))) : 0;
    const uint32_t options =
        uint32_t(tears_) * shared::kInkOverTears | uint32_t(ends_) * shared::kInkOverEnds;
    step_.setJobs({{{options, inMetres, shown | reach << shared::kInkOverKinds}, {}}});
    step_.update(u);
  }

 private:
  ImageStep step_;
  static constexpr uint32_t kSquare = 2 * shared::kInkOverReach + 1;
  bool tears_ = false, ends_ = false, shadows_ = false, pieces_ = false;
};

}  // namespace

std::unique_ptr<Pass> makeOver() {
  return std::make_unique<Over>();
}

}  // namespace scumble::ink
