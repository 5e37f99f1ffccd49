#include "passes/warp/warp.h"

#include <algorithm>
#include <cmath>

#include "frame/drawn_image.h"
#include "frame/geometry_step.h"
#include "frame/image_step.h"
#include "frame/material_params.h"
#include "frame/metatexture.h"
#include "look/anywhere.h"
#include "passes/final_shadow/final_shadow_knobs.h"
#include "passes/limit/limit_knobs.h"
#include "passes/warp/warp.shared.h"
#include "passes/warp/warp_knobs.h"
#include "shaders/warp_image_comp.h"
#include "shaders/warp_image_frag.h"
#include "shaders/warp_surface_frag.h"
#include "shaders/warp_surface_vert.h"
#include "stage/animation_params.h"
#include "stage/playing.h"

namespace scumble::passes {

using namespace frame;

namespace {

// Mirrors WarpMaterial in warp.glsl.
struct WarpMaterial {
  float amount, least, inflation, distance, setup, characterSetup;
};

// Mirrors the block of warp.image.glsl.
struct SetupUniforms {
  MetaTextureUniforms field, marks;
  uint32_t setup;
  float marksAmount;
  glm::vec2 fieldMean;
  float marksMean;
};

// Materials that share textures and knobs are evaluated together: a setup, one job of the image step.
struct WarpSetup {
  MetaTextureUse field, marks;
  float marksAmount = 1;
  bool operator==(const WarpSetup&) const = default;

  // One evaluation serves both where the marks are the field's blue channel.
  bool isApart() const { return !(field == marks); }
};

// The jobs of an image step.
class Jobs {
 public:
  Jobs(ImageStep& step, const std::vector<WarpSetup>& setups) : step_(step), setups_(setups) {}
  // `needs`: kWarpVectors ...; nothing: zeros, whatever the setup.
  void add(size_t index, uint32_t needs, TileChoice where) {
    const WarpSetup& setup = setups_[index];
    step_.update(SetupUniforms{setup.field.meta.uniforms(), setup.marks.meta.uniforms(), uint32_t(index + 1),
                               setup.marksAmount, glm::vec2(setup.field.example->statistics.mean),
                               setup.marks.example->statistics.mean.b},
                 jobs_.size());
    if (needs != 0)
      needs |= (setup.isApart() ? shared::kWarpApart : 0) | (setups_.size() > 1 ? shared::kWarpSeveral : 0);
    jobs_.push_back({{needs, setup.field.meta.features(), setup.marks.meta.features()},
                     {{shared::kWarpFieldExample, &setup.field.image(), setup.field.sampler()},
                      {shared::kWarpFieldInverse, &setup.field.inverse(), ExampleTextures::kInverseSampler},
                      {shared::kWarpMarksExample, &setup.marks.image(), setup.marks.sampler()},
                      {shared::kWarpMarksInverse, &setup.marks.inverse(), ExampleTextures::kInverseSampler}},
                     where});
  }
  void finish() { step_.setJobs(jobs_); }

 private:
  ImageStep& step_;
  const std::vector<WarpSetup>& setups_;
  std::vector<ImageStep::Job> jobs_;
};

class Warp : public Pass {
 public:
  const char* name() const override { return "warp"; }
  std::span<const Aov> aovs() const override { return kAovs; }

  void declare(FrameBuilder& frame, uint32_t) override {
    isAsked_ = frame.isAsked(kAovs[0]);
    gpu::Handle depth = mask_.declare(frame, name(), "warp depth", {shared::kTileMarked, 0});
    frame.step(name(), [this](VkCommandBuffer commands) { record(commands); });
    GeometryStep::use(frame);
    pattern_.declare(frame, "warp pattern", kPatternFormat);
    knobs_.declare(frame, "warp knobs", kKnobsFormat);
    depth_ = depth = frame.use(depth, gpu::Use::depthTarget);
    frame.give(kInflatedDepth, depth);

    const auto declareImage = [&](ImageStep& step, const std::string& image, uint32_t jobs) {
      return step.declare(
          frame,
          {.name = name(),
           .shader = {{shaders::warp_image_frag}, {shaders::warp_image_comp}},
           .inputs = {{shared::kWarpPattern, pattern_.image()},
                      {shared::kWarpKnobs, knobs_.image()},
                      {shared::kWarpDepth, depth}},
           .textures = {shared::kWarpFieldExample, shared::kWarpFieldInverse, shared::kWarpMarksExample,
                        shared::kWarpMarksInverse},
           .tiles = frame.get(kTiles),
           .outputs = {frame.image(image, {.format = kHalves})},
           .fetches = 3 + 8 * 4,
           .uniformBytes = sizeof(SetupUniforms),
           .maxJobs = jobs * kMostSetups * uint32_t(std::max<size_t>(1, frame.scene().materialCount()))})[0];
    };
    frame.give(kWarp, declareImage(image_, name(), kMostJobs));
    // The picture looks at what it would look at anyway.
    if (isAsked_) frame.offer(kAovs[0], {declareImage(saved_, "warp to be saved", 1)});
  }

  void create(FrameBuilder& frame) override {
    materials_.create(frame);
    configuration_ = frame.configuration();
    constexpr VkShaderStageFlags kStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
    layout_ = gpu::SetLayout(frame.device(), {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, kStages}});
    sets_ = gpu::DescriptorSets(frame.device(), layout_);
    materials_.bind(sets_, 0);

    GeometryStepDesc desc;
    desc.what = GeometryStepDesc::What::torn;
    desc.vertex = {shaders::warp_surface_vert};
    desc.fragment = {shaders::warp_surface_frag};
    desc.inputs = kPosition | kUv0 | kUv1 | kColor | kDPdu | kSmoothNormal | kDPdv | kPatternUv | kWarpScale;
    desc.colorFormats = {kPatternFormat, kKnobsFormat};
    desc.viewMask = configuration_.views().mask();
    desc.viewCount = configuration_.viewCount;
    desc.passLayout = &layout_;
    desc.materialStrides = {materials_.kStride};
    step_.create(frame, desc);
    mask_.create(frame);
    image_.create(frame);
    if (isAsked_) saved_.create(frame);
    examples_ = &frame.examples();
  }
  void bind(const gpu::GraphResources& resources) override {
    resources_ = &resources;
    mask_.bind(resources);
    image_.bind(resources);
    if (isAsked_) saved_.bind(resources);
  }

  void update(const FrameInput& input) override {
    std::vector<WarpSetup> setups;
    std::vector<MaterialVariant> variants;
    const float pixelScale = input.uniforms.pixelScale;
    for (size_t m = 0; m < input.scene.materialCount(); ++m) {
      const WarpParams params = input.knobs.of<WarpParams>(m);
      const auto metaParams = input.knobs.of<WarpMetaTextureParams>(m);
      // Numbers of setups, from 1 on.
      const auto numberOf = [&](const WarpSetup& setup) {
        const auto at = std::find(setups.begin(), setups.end(), setup);
        if (at != setups.end()) return float(at - setups.begin() + 1);
        if (setups.size() < shared::kMostWarpSetups) setups.push_back(setup);
        return float(setups.size());
      };
      const int posesStand = input.knobs.of<AnimationParams>(m).hold;
      const WarpSetup setup =
          setupOf(input, m, metaParams,
                  boilOf(input, params.boil, params.boilHold > 0 ? params.boilHold : posesStand,
                         params.boilDrawings));
      const float number = numberOf(setup);
      float characterNumber = number;
      if (params.characterBoil > params.boil && !input.scene.data().skins.empty())
        characterNumber = numberOf(setupOf(
            input, m, metaParams, boilOf(input, params.characterBoil, posesStand, params.boilDrawings)));
      const float inflation = params.inflationUnit == 0
                                  ? params.inflation * pixelScale
                                  : params.inflation * 0.01f * input.uniforms.knobHeight;
      const world::FeaturePlan* const plan = input.scene.planOf(m);
      const float distance = plan && plan->quietDistance > 0
                                 ? std::max(params.distance, 1 / plan->quietDistance)
                                 : params.distance;
      const uint32_t options =
          (distance > 0 ? shared::kWarpFades : 0) | (setup.field.meta.mode == 0 ? shared::kWarpFollows : 0);
      variants.push_back({.tangents = tangentOptions(metaParams, input.uniforms), .options = options});
      // What a feature quietens has no floor: a horizon is a clear line.
      const float least = plan && plan->quietDistance > 0 ? 0 : std::min(params.least, params.amount);
      materials_.write(
          m, {params.amount * pixelScale, least * pixelScale, inflation, distance, number, characterNumber});
    }
    step_.specialise(0, std::move(variants));

    const bool everywhere = marksUse(input.knobs) == MarksUse::everywhere;
    mask_.setWhole(isAsked_ || everywhere);
    Jobs jobs{image_, setups};
    using namespace shared;
    for (size_t i = 0; i < setups.size(); ++i) {
      if (everywhere) {
        jobs.add(i, kWarpVectors | kWarpMarks, {});
        continue;
      }
      // Vectors are looked at where something is torn, and marks where light turns into shadow. Marks that
      // are not the vectors' own cost as much as these.
      if (setups[i].isApart()) {
        jobs.add(i, kWarpVectors | kWarpMarks, {kTileTorn | kTileShaded, kTileTorn | kTileShaded});
        jobs.add(i, kWarpVectors, {kTileTorn | kTileShaded, kTileTorn});
      } else {
        jobs.add(i, kWarpVectors | kWarpMarks, {kTileTorn, kTileTorn});
      }
      jobs.add(i, kWarpMarks, {kTileTorn | kTileShaded, kTileShaded});
    }
    // Beside what is torn vectors are mixed in where nobody sees what they move.
    if (!everywhere) jobs.add(0, 0, {kTileMarked | kTileTorn | kTileShaded, kTileMarked});
    jobs.finish();
    if (!isAsked_) return;
    Jobs saved{saved_, setups};
    for (size_t i = 0; i < setups.size(); ++i) saved.add(i, kWarpVectors | kWarpMarks, {});
    saved.finish();
  }

 private:
  static constexpr Aov kAovs[] = {{.name = "warp"}};
  static constexpr uint32_t kMostJobs = 4;    // of a setup, counting what all have in common
  static constexpr uint32_t kMostSetups = 2;  // of a material: what a skeleton moves, and what none does
  static constexpr VkFormat kPatternFormat = VK_FORMAT_R32G32B32A32_UINT, kKnobsFormat = VK_FORMAT_R32_UINT;

  // How far the pattern lies aside in the drawing that line boil shows, in copies.
  static glm::vec2 boilOf(const FrameInput& input, float boil, int hold, int drawings) {
    const int drawing = boilDrawing(drawings, hold, input.time);
    return drawing ? boil * patternShift(0x5EA0u + 2 * uint32_t(drawing)) : glm::vec2(0.0f);
  }

  WarpSetup setupOf(const FrameInput& input, size_t material, const WarpMetaTextureParams& metaParams,
                    const glm::vec2& boil) const {
    const BreakupParams breakup = input.knobs.of<BreakupParams>(material);
    const auto breakupMeta = sameRows(input.knobs.of<BreakupMetaTextureParams>(material));
    const glm::vec2 shift = patternShift(input.seed) + boil;
    const float pixelScale = input.uniforms.pixelScale;
    WarpSetup setup{metaTextureUse(metaParams, 0b0011, input.look, *examples_, pixelScale, shift),
                    metaTextureUse(breakupMeta, 0b0100, input.look, *examples_, pixelScale, shift),
                    breakup.amount};
    setup.field.meta.wrapping = setup.marks.meta.wrapping = input.scene.wraps();
    return setup;
  }

  void record(VkCommandBuffer commands) const {
    // Where nothing is, knobs are 0 and the pattern is not looked at.
    const gpu::Target colors[] = {pattern_.target(*resources_, {}, gpu::Target::Before::undefined),
                                  knobs_.target(*resources_)};
    const gpu::Target depth{&resources_->image(depth_), nullptr, {}, gpu::Target::Before::kept};
    gpu::drawViews(commands, configuration_.views(), colors, &depth,
                   [&](uint32_t firstView) { step_.draw(commands, &sets_, firstView); });
  }

  bool isAsked_ = false;
  TileMask mask_;
  DrawnImage pattern_, knobs_;
  gpu::Handle depth_{};
  const gpu::GraphResources* resources_ = nullptr;
  Configuration configuration_;
  MaterialBlocks<WarpMaterial> materials_;
  ExampleTextures* examples_ = nullptr;
  gpu::SetLayout layout_;
  gpu::DescriptorSets sets_;
  GeometryStep step_;
  ImageStep image_, saved_;
};

}  // namespace

float inflationPixels(const WarpParams& params, float imageHeight) {
  return params.inflation * imageHeight / (params.inflationUnit == 0 ? 1080.0f : 100.0f);
}

bool mayTear(const look::LookData& look) {
  return look::mayBeAboveZero(look, &WarpParams::amount);
}

MarksUse marksUse(const stage::KnobTable& knobs) {
  const FinalShadowParams shadow = knobs.scene<FinalShadowParams>();
  if (!isPlainApartFromEdges(shadow) || limitsByMarks(knobs.scene<LimitParams>()))
    return MarksUse::everywhere;
  return shadesByMarks(shadow) ? MarksUse::shaded : MarksUse::none;
}

int boilDrawing(int drawings, int hold, double time) {
  hold = std::max(hold, 1);
  const double drawing = std::round(stage::heldTime(time, hold) * 24 / hold);
  return int(drawing - drawings * std::floor(drawing / drawings));
}

std::unique_ptr<Pass> makeWarp() {
  return std::make_unique<Warp>();
}

}  // namespace scumble::passes
