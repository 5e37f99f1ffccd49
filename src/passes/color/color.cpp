#include "passes/color/color.h"

#include <algorithm>
#include <cmath>

#include "frame/image_step.h"
#include "passes/color/color.shared.h"
#include "passes/color/color_knobs.h"
#include "passes/final_shadow/final_shadow_knobs.h"
#include "shaders/color_image_comp.h"
#include "shaders/color_image_frag.h"
#include "stage/palette.h"

namespace scumble::passes {

using namespace frame;

glm::vec2 airDistances(const BackgroundParams& params, const shared::FrameUniforms& frame) {
  const float center = glm::length(frame.sceneCenter - frame.viewer);
  return center +
         frame.sceneRadius * glm::vec2(params.airStart, std::max(params.airEnd, params.airStart + 1e-3f));
}

namespace {

class Color : public Pass {
 public:
  explicit Color(Layer layer) : layer_(layer) {}
  const char* name() const override { return layer_ == Layer::first ? "color" : "behind"; }
  std::span<const Aov> aovs() const override { return kAovs; }

  void declare(FrameBuilder& frame, uint32_t) override {
    const gpu::Handle picture =
        step_.declare(frame, {.name = name(),
                              .shader = {{shaders::color_image_frag}, {shaders::color_image_comp}},
                              .inputs = {{shared::kColorLight, frame.get(kLight, layer_)},
                                         {shared::kColorLit, frame.get(kLit, layer_)},
                                         {shared::kColorShadowed, frame.get(kShadowed, layer_)},
                                         {shared::kColorDepth, frame.get(kDepth, layer_)}},
                              .tiles = frame.get(kTiles),
                              .outputs = {frame.image(name(), {.format = kHalves})},
                              .uniformBytes = sizeof(shared::ColorUniforms),
                              .maxJobs = 4})[0];
    frame.give(kPicture, picture, layer_);
    if (layer_ == Layer::first) frame.offer(kAovs[0], {picture});
  }
  void create(FrameBuilder& frame) override { step_.create(frame); }
  void bind(const gpu::GraphResources& resources) override { step_.bind(resources); }

  void update(const FrameInput& input) override {
    const BackgroundParams params = input.knobs.scene<BackgroundParams>();
    shared::ColorUniforms uniforms{};
    uniforms.knobs = params;
    uniforms.horizon = params.horizon;
    uniforms.zenith = params.zenith;
    if (params.mode == 0) {
      const BackgroundColors colors = automaticBackground(input.scene.colors());
      uniforms.horizon = colors.horizon;
      uniforms.zenith = colors.zenith;
    }
    uniforms.height = std::sin(glm::radians(params.height));
    const glm::vec2 air = airDistances(params, input.uniforms);
    uniforms.airStart = air.x, uniforms.airEnd = air.y;
    uniforms.transparent = input.transparent;
    const FinalShadowParams shadow = input.knobs.scene<FinalShadowParams>();
    uniforms.deepGlow = deepGlow(shadow);
    uniforms.glowColor = shadow.glowColor;
    // What lies behind has light without a blur, and no glow.
    uniforms.glowColorAmount = layer_ == Layer::first ? shadow.glowColorAmount : 0;
    // Several steps are mixed in equal parts of value, not of light.
    uniforms.mixesValues = shadow.steps > 1;
    using namespace shared;
    std::vector<ImageStep::Job> jobs{{{kPartAll}, {}}};
    // Before a picture the ground covers pixels and has no colour.
    if (layer_ == Layer::first && isPlainApartFromEdges(shadow) && !input.backdrop)
      jobs = {{{kPartAll}, {}, {kTileCovered | kTilePlain, kTileCovered}},
              {{kPartSky}, {}, {kTileCovered, 0}},
              {{kPartLit}, {}, {kTilePlain | kTileLit, kTilePlain | kTileLit}},
              {{kPartDark}, {}, {kTilePlain | kTileLit, kTilePlain}}};
    step_.setJobs(jobs);
    for (size_t job = 0; job < jobs.size(); ++job) step_.update(uniforms, job);
  }

 private:
  static constexpr Aov kAovs[] = {{.name = "color", .isColor = true, .premultiplied = 3}};

  Layer layer_;
  ImageStep step_;
};

}  // namespace

std::unique_ptr<Pass> makeColor(Layer layer) {
  return std::make_unique<Color>(layer);
}

}  // namespace scumble::passes
