// Draws lines of the edges of meshes.
#include <algorithm>
#include <cmath>
#include <map>

#include "features/ink/ink.h"
#include "features/ink/ink_knobs.h"
#include "features/ink/lines/line_finder.h"
#include "features/ink/lines/line_table.h"
#include "frame/drawn_image.h"
#include "frame/material_params.h"
#include "look/anywhere.h"
#include "passes/colorize/colorize_knobs.h"
#include "passes/warp/warp_knobs.h"
#include "shaders/ink_line_cover_frag.h"
#include "shaders/ink_line_distance_frag.h"
#include "shaders/ink_line_frag.h"
#include "shaders/ink_line_vert.h"
#include "stage/light.h"

namespace scumble::ink {

using namespace frame;

namespace {

constexpr float kRadians = 3.14159265f / 180;
// Creases come within so many degrees before and after their angle, so that none breaks into dashes where it
// is about as sharp.
constexpr float kCreaseFade = 4;

template <class Params>
shared::InkKind kindOf(const KnobTable& knobs) {
  const Params p = knobs.scene<Params>();
  return {p.width, glm::sqrt(p.color.linear), p.colorAmount};
}

// Two anti-aliased edges that only touch would leave a light seam, and more so two that are torn apart; what
// is not torn is whole to within half a pixel.
float overlap(const FrameInput& input) {
  return passes::mayTear(input.look) ? std::max(0.75f, 2.4f * input.uniforms.pixelScale) : 0.5f;
}

shared::InkUniforms inkUniforms(const FrameInput& input) {
  const InkParams params = input.knobs.scene<InkParams>();
  shared::InkUniforms u{};
  u.least = params.least, u.greatest = params.greatest;
  u.keyLight = keyLight(input.scene.data(), input.knobs.scene<LightParams>(), input.scene.motion().world(),
                        input.scene.motion().shown());
  u.offset = params.offset;
  u.overlap = overlap(input);
  u.doubled = params.doubled, u.doubledWidth = params.doubledWidth;
  u.cosSmooth = std::cos(params.smoothAngle * kRadians);
  u.cosCrease = std::cos(std::max(params.creaseAngle - kCreaseFade, 0.0f) * kRadians);
  u.cosCreaseFull = std::cos(std::min(params.creaseAngle + kCreaseFade, 180.0f) * kRadians);
  u.fade = params.fade;
  u.sinFadeAngle = std::sin(params.fadeAngle * kRadians);
  u.outer = params.outer;
  u.texture = params.textureAmount;
  u.textureSize = params.textureSize * input.uniforms.pixelScale;
  u.hidden = params.hidden, u.hiddenDash = params.hiddenDash * input.uniforms.pixelScale;
  u.kinds[shared::kInkSilhouette] = kindOf<SilhouetteParams>(input.knobs);
  u.kinds[shared::kInkBoundary] = kindOf<BoundaryParams>(input.knobs);
  u.kinds[shared::kInkMaterial] = kindOf<MaterialBorderParams>(input.knobs);
  u.kinds[shared::kInkCrease] = kindOf<CreaseParams>(input.knobs);
  u.kinds[shared::kInkColor] = kindOf<ColorBorderParams>(input.knobs);
  return u;
}

template <class Params>
uint32_t shownBit(const KnobTable& knobs, int kind) {
  const Params p = knobs.scene<Params>();
  return uint32_t(p.shown && p.width > 0) << (shared::kInkKindsBit + kind);
}

template <class... Params>
bool haveColors(const look::LookData& look) {
  return ((look.get<Params>().shown && look.get<Params>().colorAmount > 0) || ...);
}

// True for lines that may have several colours: it is seen then which of two lies over the other.
bool mayHaveColors(const scene::SceneData& scene, const look::LookData& look) {
  for (const look::Target target : {look::kMaterials, look::kNodes})
    if (look.setsAny(LineParams::block(), "color", target)) return true;
  if (look::mayBeAboveZero(look, &LineParams::ownColor) ||
      haveColors<SilhouetteParams, BoundaryParams, MaterialBorderParams, CreaseParams, ColorBorderParams>(
          look))
    return true;
  return look.get<InkParams>().ownOutlines &&
         std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const scene::Material& material) { return material.outline.has_value(); });
}

uint32_t inkChoices(const FrameInput& input) {
  const InkParams params = input.knobs.scene<InkParams>();
  return uint32_t(params.unit) << shared::kInkUnitBit | uint32_t(params.weights) << shared::kInkWeightsBit |
         uint32_t(params.placement) << shared::kInkPlacementBit |
         uint32_t(params.cyclopean) << shared::kInkCyclopeanBit |
         uint32_t(params.doubled != 0 && params.doubledWidth > 0) << shared::kInkDoubledBit |
         uint32_t(params.textureAmount > 0 ? int(params.texture) : shared::kInkPlain)
             << shared::kInkTextureBit |
         uint32_t(params.breaks) << shared::kInkBreaksBit |
         uint32_t(params.hidden > 0) << shared::kInkHiddenBit |
         uint32_t(input.uniforms.lightCount > 0) << shared::kInkLampsBit |
         shownBit<SilhouetteParams>(input.knobs, shared::kInkSilhouette) |
         shownBit<BoundaryParams>(input.knobs, shared::kInkBoundary) |
         shownBit<MaterialBorderParams>(input.knobs, shared::kInkMaterial) |
         shownBit<CreaseParams>(input.knobs, shared::kInkCrease) |
         shownBit<ColorBorderParams>(input.knobs, shared::kInkColor);
}

class Lines : public Pass {
 public:
  const char* name() const override { return "ink"; }
  std::span<const Aov> aovs() const override { return kAovs; }
  uint32_t variant(const scene::SceneData& scene, const look::LookData& look) const override {
    return uint32_t(mayShow(look)) + 2 * uint32_t(passes::changesOverlays(look, scene)) +
           4 * uint32_t(mayHaveColors(scene, look));
  }

  void declare(FrameBuilder& frame, uint32_t variant) override {
    configuration_ = frame.configuration();
    isShown_ = variant & 1, hasNearness_ = isShown_ && variant & 2, covers_ = isShown_ && variant & 4;
    if (!isShown_) {
      // Whoever asks for it gets none.
      frame.step(name(), [this](VkCommandBuffer commands) { record(commands); });
      strokes_.declare(frame, "ink", kBytes);
      frame.offer(kAovs[0], {strokes_.image()});
      return;
    }
    frame.step("ink-lines", [this](VkCommandBuffer commands) { finder_.record(commands); });
    frame.use(frame.get(kVertices), gpu::Use::storageBufferRead);
    const gpu::Handle numbers =
        frame.use(frame.graph().importBuffer("ink lines"), gpu::Use::storageBufferWrite);
    const gpu::Handle command =
        frame.use(frame.graph().importBuffer("ink draw"), gpu::Use::storageBufferWrite);

    hasTable_ = frame.isAsked(kAovs[1]);
    if (hasTable_) {
      table_.declare(frame, numbers, command);
      frame.offer(kAovs[1], {table_.image()});
    }

    const auto useLines = [&] {
      frame.use(frame.get(kVertices), gpu::Use::storageBufferReadByVertex);
      frame.use(numbers, gpu::Use::storageBufferReadByVertex);
      frame.use(command, gpu::Use::indirectBuffer);
      depth_ = frame.use(frame.get(kDepth), gpu::Use::sampledByFragment);
    };
    if (covers_) {
      frame.step("ink-nearest", [this](VkCommandBuffer commands) { recordNearest(commands); });
      useLines();
      nearest_.declare(frame, "ink nearest", kDepthFormat);
    }
    frame.step(name(), [this](VkCommandBuffer commands) { record(commands); });
    useLines();
    if (covers_) frame.use(nearest_.image(), gpu::Use::sampledByFragment);
    shadowed_ = frame.use(frame.get(kShadowed), gpu::Use::sampledByFragment);
    strokes_.declare(frame, "ink", kBytes);
    frame.give(kStrokes, strokes_.image());
    if (hasNearness_) {
      nearness_.declare(frame, kStrokesNearness.name, kHalves);
      frame.give(kStrokesNearness, nearness_.image());
    }
    frame.offer(kAovs[0], {strokes_.image()});
  }

  void create(FrameBuilder& frame) override {
    frame_ = &frame;
    if (!isShown_) return;
    uniforms_ = frame.uniform(sizeof(shared::InkUniforms));
    lines_ = frame.uniform(frame.scene().materialCount() * sizeof(shared::InkLine));
    finder_.create(frame, uniforms_, lines_);
    if (hasTable_) table_.create(frame, finder_);
    layout_ = gpu::SetLayout(frame.device(),
                             {{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT},
                              {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT},
                              {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT}});
    set_ = gpu::DescriptorSets(frame.device(), layout_, 2);
  }

  void bind(const gpu::GraphResources& resources) override {
    resources_ = &resources;
    if (!isShown_) return;
    finder_.bind();
    if (hasTable_) table_.bind(resources);
    const VkSampler exact = frame_->samplers().get({VK_FILTER_NEAREST});
    // One set for the step that finds the nearest line, one for that which draws all of them.
    for (size_t set = 0; set < set_.size(); ++set) {
      const gpu::Handle nearest = covers_ && set == kDrawing ? nearest_.image() : depth_;
      set_.rewriteTexture(set, shared::kInkDepth, resources.image(depth_).view(), exact);
      set_.rewriteTexture(set, shared::kInkShadowed, resources.image(shadowed_).view(), exact);
      set_.rewriteTexture(set, shared::kInkNearest, resources.image(nearest).view(), exact);
    }
  }

  void update(const FrameInput& input) override {
    if (!isShown_) return;
    shared::InkUniforms uniforms = inkUniforms(input);
    uniforms.addresses = finder_.addresses();
    // The first of several samples gives the depth, from where Vulkan's standard has it.
    uniforms.depthAt = configuration_.samples == 1 ? glm::vec2(0.5f) : glm::vec2(0.375f, 0.125f);
    uniforms_.write(uniforms);
    choices_ = inkChoices(input) | uint32_t(covers_) << shared::kInkCoversBit;
    finder_.specialise(choices_);
    if (hasTable_) table_.specialise(choices_);
    if (!pipelines_.contains(choices_))
      pipelines_[choices_] = {makePipeline(choices_), makeNearest(choices_)};
    auto* const lines = reinterpret_cast<shared::InkLine*>(lines_.mapped);
    const bool ownOutlines = input.knobs.scene<InkParams>().ownOutlines;
    for (size_t m = 0; m < input.scene.materialCount(); ++m) {
      const LineParams line = input.knobs.of<LineParams>(m);
      const scene::Material& material = input.scene.material(m);
      lines[m] = {line.width, glm::sqrt(line.color.linear), line.ownColor, uint32_t(!material.doubleSided)};
      if (!ownOutlines || !material.outline) continue;
      const scene::Outline& outline = *material.outline;
      lines[m].hasOutline = 1;
      lines[m].outlineUnit =
          outline.unit == scene::Outline::Unit::metres ? shared::kInkMetres : shared::kInkPixels;
      lines[m].outlineWidth = outline.width;
      lines[m].outlineColor = glm::sqrt(outline.color);
      lines[m].outlineLight = outline.lightingMix;
    }
  }

 private:
  gpu::Pipeline makePipeline(uint32_t choices) const {
    gpu::GraphicsPipelineDesc desc;
    describe(desc, choices);
    desc.colorFormats = {kBytes};
    if (hasNearness_) {
      desc.fragment = {shaders::ink_line_distance_frag};
      desc.colorFormats.push_back(kHalves);
    } else {
      desc.fragment = {shaders::ink_line_frag};
    }
    desc.blend = gpu::Blend::greatest;
    return gpu::Pipeline(frame_->device(), desc);
  }
  // How near the nearest line is.
  gpu::Pipeline makeNearest(uint32_t choices) const {
    if (!covers_) return {};
    gpu::GraphicsPipelineDesc desc;
    describe(desc, choices);
    desc.fragment = {shaders::ink_line_cover_frag};
    desc.depthFormat = kDepthFormat;
    return gpu::Pipeline(frame_->device(), desc);
  }
  void describe(gpu::GraphicsPipelineDesc& desc, uint32_t choices) const {
    desc.vertex = {shaders::ink_line_vert};
    desc.constants = finder_.constants(choices);
    desc.viewMask = configuration_.views().mask();
    desc.sets = {frame_->frameLayout().handle(), finder_.layout().handle(), layout_.handle()};
    desc.pushConstantBytes = 4;
  }

  void record(VkCommandBuffer commands) const {
    std::vector<gpu::Target> targets{strokes_.target(*resources_)};
    if (hasNearness_) targets.push_back(nearness_.target(*resources_));
    gpu::drawViews(commands, configuration_.views(), targets, nullptr, [&](uint32_t firstView) {
      if (isShown_ && !finder_.isEmpty())
        draw(commands, pipelines_.at(choices_).lines, set_[kDrawing], firstView);
    });
  }
  void recordNearest(VkCommandBuffer commands) const {
    const gpu::Target target = nearest_.target(*resources_);
    gpu::drawViews(commands, configuration_.views(), {}, &target, [&](uint32_t firstView) {
      if (!finder_.isEmpty()) draw(commands, pipelines_.at(choices_).nearest, set_[kFinding], firstView);
    });
  }
  void draw(VkCommandBuffer commands, const gpu::Pipeline& pipeline, VkDescriptorSet images,
            uint32_t firstView) const {
    pipeline.bind(commands);
    pipeline.bindSet(commands, 0, frame_->frameSet());
    pipeline.bindSet(commands, 1, finder_.set());
    pipeline.bindSet(commands, 2, images);
    pipeline.push(commands, firstView);
    vkCmdDrawIndirect(commands, finder_.command(), 0, 1, 0);
  }

  static constexpr Aov kAovs[] = {{.name = "ink"},
                                  {.name = kLineTableAov, .hasOwnSize = true, .isInternal = true}};

  static constexpr size_t kFinding = 0, kDrawing = 1;  // of set_

  FrameBuilder* frame_ = nullptr;
  bool isShown_ = false, hasTable_ = false, hasNearness_ = false, covers_ = false;
  Configuration configuration_;
  UniformSlice uniforms_, lines_;
  LineFinder finder_;
  LineTable table_;
  gpu::Handle depth_, shadowed_;
  DrawnImage strokes_, nearness_, nearest_;
  const gpu::GraphResources* resources_ = nullptr;
  gpu::SetLayout layout_;
  gpu::DescriptorSets set_;
  uint32_t choices_ = 0;
  struct Pipelines {
    gpu::Pipeline lines, nearest;
  };
  std::map<uint32_t, Pipelines> pipelines_;  // by choices
};

}  // namespace

std::unique_ptr<Pass> makeLines() {
  return std::make_unique<Lines>();
}

}  // namespace scumble::ink
