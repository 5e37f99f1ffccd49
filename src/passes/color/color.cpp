#include "passes/color/color.h"

#include <algorithm>
#include <cmath>

#include "frame/image_step.h"
#include "passes/color/color.shared.h"
#include "passes/color/color_knobs.h"
#include "passes/final_shadow/final_shadow_knobs.h"
#include "shaders/color_image_comp.h"
#include "shaders/color_image_frag.h"
#include "shaders/color_samples_image_comp.h"
#include "shaders/color_samples_image_frag.h"
#include "stage/palette.h"

namespace scumble::passes {

using namespace frame;

glm::vec2 airDistances(const BackgroundParams& params, const shared::FrameUniforms& frame) {
  const float center = glm::length(frame.sceneCenter - frame.viewer);
  return center +
         frame.sceneRadius * glm::vec2(params.airStart, std::max(params.airEnd, params.airStart + 1e-3f));
}

shared::SurfaceColors surfaceColors(const FrameInput& input, Layer layer) {
  const BackgroundParams params = input.knobs.scene<BackgroundParams>();
  shared::SurfaceColors colors{};
  colors.horizon = params.horizon;
  colors.zenith = params.zenith;
  if (params.mode == 0) {
    const BackgroundColors automatic = automaticBackground(input.scene.colors());
    colors.horizon = automatic.horizon;
    colors.zenith = automatic.zenith;
  }
  colors.height = std::sin(glm::radians(params.height));
  colors.air = params.air;
  const glm::vec2 air = airDistances(params, input.uniforms);
  colors.airStart = air.x, colors.airEnd = air.y;
  colors.transparent = input.transparent;
  colors.skyTones = float(params.skyTones);
  colors.skyStrokes = params.skyStrokes;
  colors.skyStrokeSize = params.skyStrokeSize * input.uniforms.pixelScale;
  colors.skyEven = 1.5f * colors.skyTones / colors.height;
  const FinalShadowParams shadow = input.knobs.scene<FinalShadowParams>();
  colors.deepGlow = deepGlow(shadow);
  colors.glowColor = shadow.glowColor;
  // What lies behind has light without a blur, and no glow.
  colors.glowColorAmount = layer == Layer::first ? shadow.glowColorAmount : 0;
  // Several steps are mixed in equal parts of value, not of light.
  colors.mixesValues = shadow.steps > 1;
  return colors;
}

std::vector<std::pair<int, TileChoice>> colorParts(const FrameInput& input, bool hasSamples) {
  using namespace shared;
  std::vector<std::pair<int, TileChoice>> parts;
  uint32_t rest = 0, covered = 0;
  // Before a picture the ground covers pixels and has no colour.
  if (isPlainApartFromEdges(input.knobs.scene<FinalShadowParams>()) && !input.backdrop) {
    parts = {{kPartSky, {kTileCovered, 0}},
             {kPartLit, {kTilePlain | kTileLit, kTilePlain | kTileLit}},
             {kPartDark, {kTilePlain | kTileLit, kTilePlain}}};
    rest = kTileCovered | kTilePlain, covered = kTileCovered;
  }
  const uint32_t mixed = hasSamples ? kTileMixed : 0;
  parts.push_back({kPartAll, {rest | mixed, covered}});
  if (hasSamples) parts.push_back({kPartMixed, {rest | mixed, covered | mixed}});
  return parts;
}

namespace {

class Color : public Pass {
 public:
  explicit Color(Layer layer) : layer_(layer) {}
  const char* name() const override { return layer_ == Layer::first ? "color" : "behind"; }
  std::span<const Aov> aovs() const override { return kAovs; }

  void declare(FrameBuilder& frame, uint32_t) override {
    hasBlended_ = layer_ == Layer::first && frame.has(kBlended);
    ImageStepDesc desc{
        .name = name(),
        .shader = {{shaders::color_image_frag}, {shaders::color_image_comp}},
        .inputs = {{shared::kColorLight, frame.get(kLight, layer_)},
                   {shared::kColorLit, frame.get(kLit, layer_)},
                   {shared::kColorShadowed, frame.get(kShadowed, layer_)},
                   {shared::kColorDepth, frame.get(kDepth, layer_)},
                   {shared::kColorBlended, frame.get(hasBlended_ ? kBlended : kLit)},
                   {shared::kColorBlendedDistance, frame.get(hasBlended_ ? kBlendedDistance : kLit)}},
        .tiles = frame.get(kTiles),
        .outputs = {frame.image(name(), {.format = kHalves})},
        .fetches = hasBlended_ ? 6u : 4u,
        .uniformBytes = sizeof(shared::SurfaceColors),
        .maxJobs = 5};
    hasSamples_ = layer_ == Layer::first && frame.configuration().samples > 1;
    if (hasSamples_) {
      desc.shader = {{shaders::color_samples_image_frag}, {shaders::color_samples_image_comp}};
      desc.fetches = 1 + 4 * (hasBlended_ ? 6 : 4);
      const std::pair<int, const Role*> samples[] = {{shared::kColorSampleLight, &kSampleLight},
                                                     {shared::kColorLitSamples, &kLitSamples},
                                                     {shared::kColorShadowedSamples, &kShadowedSamples},
                                                     {shared::kColorDepthSamples, &kDepthSamples}};
      for (const auto& [binding, role] : samples)
        desc.inputs.push_back({uint32_t(binding), frame.get(*role)});
    }
    const gpu::Handle picture = step_.declare(frame, std::move(desc))[0];
    frame.give(kPicture, picture, layer_);
    if (layer_ == Layer::first) frame.give(kSurfaceColors, picture);
    if (layer_ == Layer::first) frame.offer(kAovs[0], {picture});
  }
  void create(FrameBuilder& frame) override { step_.create(frame); }
  void bind(const gpu::GraphResources& resources) override { step_.bind(resources); }

  void update(const FrameInput& input) override {
    const shared::SurfaceColors colors = surfaceColors(input, layer_);
    std::vector<ImageStep::Job> jobs{{{shared::kPartAll, 0}, {}}};
    if (layer_ == Layer::first) {
      jobs.clear();
      for (const auto& [part, where] : colorParts(input, hasSamples_))
        jobs.push_back({{uint32_t(part), hasBlended_}, {}, where});
    }
    step_.setJobs(jobs);
    for (size_t job = 0; job < jobs.size(); ++job) step_.update(colors, job);
  }

 private:
  static constexpr Aov kAovs[] = {{.name = "color", .isColor = true, .premultiplied = 3}};

  Layer layer_;
  bool hasSamples_ = false, hasBlended_ = false;
  ImageStep step_;
};

}  // namespace

std::unique_ptr<Pass> makeColor(Layer layer) {
  return std::make_unique<Color>(layer);
}

}  // namespace scumble::passes
