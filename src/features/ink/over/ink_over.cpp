// Lays ink over the picture.
#include <cmath>

#include "features/ink/ink.h"
#include "features/ink/ink.shared.h"
#include "features/ink/ink_knobs.h"
#include "features/ink/over/ink_over.shared.h"
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
  uint32_t variant(const scene::SceneData&, const look::LookData& look) const override {
    return mayShow(look) ? 1 + 2 * passes::mayTear(look) + 4 * mayShowShadows(look) : 0;
  }

  void declare(FrameBuilder& frame, uint32_t variant) override {
    if (!variant) return;
    tears_ = variant & 2, shadows_ = variant & 4;
    frame.give(
        kPicture,
        step_.declare(frame, {.name = name(),
                              .shader = {{shaders::ink_over_image_frag}, {shaders::ink_over_image_comp}},
                              .inputs = {{shared::kInkOverPicture, frame.get(kPicture)},
                                         {shared::kInkOverStrokes, frame.get(kStrokes), true},
                                         {shared::kInkOverWarp, frame.get(tears_ ? kWarp : kLit)},
                                         {shared::kInkOverTiles, frame.get(kTiles)},
                                         {shared::kInkOverLight, frame.get(shadows_ ? kLight : kLit), true},
                                         {shared::kInkOverDepth, frame.get(kDepth)}},
                              .outputs = {frame.image(name(), {.format = kHalves})},
                              .fetches = 1 + 4 + 1 + 1 + (shadows_ ? 9 * 5 + 1u : 0),
                              .uniformBytes = sizeof(shared::InkOverUniforms)})[0]);
  }
  void create(FrameBuilder& frame) override { step_.create(frame); }
  void bind(const gpu::GraphResources& resources) override { step_.bind(resources); }
  void update(const FrameInput& input) override {
    const InkParams params = input.knobs.scene<InkParams>();
    const ShadowShapeParams shadows = input.knobs.scene<ShadowShapeParams>();
    const glm::vec3 color = input.knobs.scene<LineParams>().color.linear;
    const shared::ViewUniforms& view = input.uniforms.views[0];
    const float pixelsOfOne = 0.5f * input.uniforms.imageSize.y / std::abs(view.ndcToEyeRay.y);
    const bool inMetres = params.unit == shared::kInkMetres;
    const float scale = inMetres                             ? pixelsOfOne
                        : params.unit == shared::kInkDegrees ? glm::radians(1.0f) * pixelsOfOne
                                                             : input.uniforms.pixelScale;
    step_.setJobs({{{tears_, shadows_, inMetres}, {}}});
    step_.update(
        shared::InkOverUniforms{params.warp, 0.25f * shadows.width * (params.least + params.greatest) * scale,
                                glm::sqrt(glm::mix(color, shadows.color.linear, shadows.colorAmount))});
  }

 private:
  ImageStep step_;
  bool tears_ = false, shadows_ = false;
};

}  // namespace

std::unique_ptr<Pass> makeOver() {
  return std::make_unique<Over>();
}

}  // namespace scumble::ink
