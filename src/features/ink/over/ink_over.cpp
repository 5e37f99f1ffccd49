// Lays ink over the picture.
#include <algorithm>
#include <cmath>

#include "features/ink/ink.h"
#include "features/ink/ink.shared.h"
#include "features/ink/ink_knobs.h"
#include "features/ink/over/ink_over.shared.h"
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
  uint32_t variant(const scene::SceneData&, const look::LookData& look) const override {
    return mayShow(look) ? 1 + 2 * passes::mayTear(look) + 4 * mayShowShadows(look) + 8 * mayShowPieces(look)
                         : 0;
  }

  void declare(FrameBuilder& frame, uint32_t variant) override {
    if (!variant) return;
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
                                         {shared::kInkOverPieces, frame.get(pieces_ ? kPieces : kLit)}},
                              .outputs = {frame.image(name(), {.format = kHalves})},
                              .fetches = 1 + 4 + 1 + 2 + (shadows_ ? 2 * 9 * 5u : 0) +
                                         (pieces_ ? 1 + 12 + kSquare * kSquare : 0),
                              .uniformBytes = sizeof(shared::InkOverUniforms)})[0]);
  }
  void create(FrameBuilder& frame) override { step_.create(frame); }
  void bind(const gpu::GraphResources& resources) override { step_.bind(resources); }
  void update(const FrameInput& input) override {
    const InkParams params = input.knobs.scene<InkParams>();
    const shared::ViewUniforms& view = input.uniforms.views[0];
    const float pixelsOfOne = 0.5f * input.uniforms.imageSize.y / std::abs(view.ndcToEyeRay.y);
    const bool inMetres = params.unit == shared::kInkMetres;
    const float scale = inMetres                             ? pixelsOfOne
                        : params.unit == shared::kInkDegrees ? glm::radians(1.0f) * pixelsOfOne
                                                             : input.uniforms.pixelScale;
    shared::InkOverUniforms u{params.warp, float(input.knobs.scene<passes::FinalShadowParams>().steps)};
    uint32_t shown = 0;
    const float middle = 0.25f * (params.least + params.greatest) * scale;
    const auto add = [&]<class Params>(int kind) {
      const Params of = input.knobs.scene<Params>();
      const glm::vec3 line = input.knobs.scene<LineParams>().color.linear;
      u.kinds[kind] = {of.width * middle, glm::sqrt(glm::mix(line, of.color.linear, of.colorAmount))};
      shown |= uint32_t(of.shown && of.width > 0) << kind;
    };
    add.template operator()<ShadowShapeParams>(shared::kInkOverShadows);
    add.template operator()<LightStepParams>(shared::kInkOverSteps);
    add.template operator()<ObjectBorderParams>(shared::kInkOverObjects);
    add.template operator()<IntersectionParams>(shared::kInkOverIntersections);
    add.template operator()<CutOutParams>(shared::kInkOverCutOuts);
    if (u.steps < 2) shown &= ~(1u << shared::kInkOverSteps);
    // Only as far as the widest line needs; in metres that depends on the distance.
    float widest = 0;
    for (int kind = shared::kInkOverObjects; kind < shared::kInkOverKinds; ++kind)
      if (shown >> kind & 1) widest = std::max(widest, inMetres ? 1e9f : u.kinds[kind].radius + 0.5f);
    const uint32_t reach = pieces_ ? uint32_t(std::min(std::ceil(widest), float(shared::kInkOverReach))) : 0;
    step_.setJobs({{{tears_, inMetres, shown | reach << shared::kInkOverKinds}, {}}});
    step_.update(u);
  }

 private:
  ImageStep step_;
  static constexpr uint32_t kSquare = 2 * shared::kInkOverReach + 1;
  bool tears_ = false, shadows_ = false, pieces_ = false;
};

}  // namespace

std::unique_ptr<Pass> makeOver() {
  return std::make_unique<Over>();
}

}  // namespace scumble::ink
