// Sorts splats, and draws them over each other; and layers of paint over those.
#include "features/painting/fins/fins.h"
#include "features/painting/painting.h"
#include "features/painting/painting_knobs.h"
#include "features/painting/strokes_on_gpu.h"
#include "features/painting/uniforms.h"
#include "frame/drawn_image.h"
#include "gpu/dispatch.h"
#include "gpu/prefix_sum.h"
#include "passes/colorize/colorize_knobs.h"
#include "shaders/painting_keys_comp.h"
#include "shaders/painting_splat_distance_frag.h"
#include "shaders/painting_splat_frag.h"
#include "shaders/painting_splat_vert.h"
#include "shading/geometry_constants.shared.h"

namespace scumble::painting {

using namespace frame;

namespace {

class Splats : public Pass {
 public:
  const char* name() const override { return "painting"; }
  std::span<const Aov> aovs() const override { return kAovs; }
  uint32_t variant(const scene::SceneData& scene, const look::LookData& look) const override {
    const bool isShown = drawnPaintings(scene, look) > 0;
    const bool takesLight = isShown && look.get<PaintingParams>().light > 0;
    return 8 * uint32_t(passes::changesOverlays(look, scene)) + 4 * uint32_t(isShown) +
           2 * uint32_t(showsLayers(scene, look)) + uint32_t(takesLight);
  }

  void declare(FrameBuilder& frame, uint32_t variant) override {
    isShown_ = variant & 4, hasLayers_ = variant & 2, takesLight_ = variant & 1;
    hasDistance_ = variant & 8 && (isShown_ || hasLayers_);
    configuration_ = frame.configuration();
    if (isShown_) {
      frame.step("painting-order", [this](VkCommandBuffer commands) { order(commands); });
      frame.use(frame.get(kPlacedPoints), gpu::Use::storageBufferRead);
      order_ = frame.use(frame.graph().importBuffer("painting order"), gpu::Use::storageBufferWrite);
    }
    // Splats sink into what is there, so they read its depth; layers are tested against it, as attachment.
    if (hasSplatStep()) {
      frame.step(name(), [this](VkCommandBuffer commands) { recordSplats(commands); });
      if (isShown_) {
        frame.use(frame.get(kPlacedPoints), gpu::Use::storageBufferReadByVertex);
        frame.use(order_, gpu::Use::storageBufferReadByVertex);
        depth_ = frame.use(frame.get(kDepth), gpu::Use::sampledByFragment);
        shadowMap_ = frame.use(frame.get(kShadowMap), gpu::Use::sampledByVertex);
      }
      declareImages(frame);
    }
    if (hasLayers_) {
      frame.step(name(), [this](VkCommandBuffer commands) { recordLayers(commands); });
      fins_.declare(frame);
      if (hasSplatStep()) {
        paint_.declareAgain(frame);
        if (hasDistance_) distance_.declareAgain(frame);
      } else {
        declareImages(frame);
      }
    }
    if (isShown_ || hasLayers_) frame.give(kOverlay, paint_.image(), Layer::paint);
    if (hasDistance_) frame.give(kOverlayDistance, distance_.image(), Layer::paint);
    frame.offer(kAovs[0], {paint_.image()});
  }

  void create(FrameBuilder& frame) override {
    frame_ = &frame;
    if (hasLayers_) fins_.create(frame, formats());
    if (!isShown_) return;
    uniforms_ = frame.uniform(sizeof(shared::PaintingUniforms));
    constexpr VkShaderStageFlags kPlaces = VK_SHADER_STAGE_COMPUTE_BIT | VK_SHADER_STAGE_VERTEX_BIT;
    std::vector<gpu::Binding> bindings(shared::kPaintingBindings,
                                       {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kPlaces});
    bindings[shared::kPaintingBlock] = {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                                        kPlaces | VK_SHADER_STAGE_FRAGMENT_BIT};
    layout_ = gpu::SetLayout(frame.device(), std::move(bindings));
    set_ = gpu::DescriptorSets(frame.device(), layout_);
    set_.writeBuffer(0, shared::kPaintingBlock, uniforms_.buffer, uniforms_.offset, uniforms_.size);
    textureLayout_ = gpu::SetLayout(
        frame.device(), {{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT},
                         {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT},
                         {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_VERTEX_BIT}});
    textures_ = gpu::DescriptorSets(frame.device(), textureLayout_);

    gpu::ComputePipelineDesc compute;
    compute.sets = {frame.frameLayout().handle(), layout_.handle()};
    compute.pushConstantBytes = 4;
    compute.constants.resize(size_t(shared::kViewCountId) + 1);
    compute.constants.back() = configuration_.viewCount;
    compute.shader = {shaders::painting_keys_comp};
    keysPipeline_ = gpu::Pipeline(frame.device(), compute);

    gpu::GraphicsPipelineDesc desc;
    desc.vertex = {shaders::painting_splat_vert};
    if (hasDistance_)
      desc.fragment = {shaders::painting_splat_distance_frag};
    else
      desc.fragment = {shaders::painting_splat_frag};
    desc.blend = gpu::Blend::premultiplied;
    desc.constants.resize(size_t(shared::kPassId) + 1);
    desc.constants[size_t(shared::kViewCountId)] = configuration_.viewCount;
    desc.constants[size_t(shared::kPassId)] = takesLight_;
    desc.colorFormats = formats();
    desc.viewMask = configuration_.views().mask();
    desc.sets = {frame.frameLayout().handle(), layout_.handle(), textureLayout_.handle()};
    desc.pushConstantBytes = 4;
    drawPipeline_ = gpu::Pipeline(frame.device(), desc);
  }

  void bind(const gpu::GraphResources& resources) override {
    resources_ = &resources;
    if (hasLayers_) fins_.bind();
    if (!isShown_) return;
    textures_.rewriteTexture(0, shared::kPaintingDepth, resources.image(depth_).view(),
                             frame_->samplers().get({VK_FILTER_NEAREST}));
    textures_.rewriteTexture(0, shared::kPaintingShadowMap, resources.image(shadowMap_).view(),
                             frame_->samplers().get({.compareLess = true}));
    const StrokesOnGpu* const strokes = this->strokes();
    if (!strokes || strokes->splatCount() == 0) return;
    if (sort_.most() < strokes->splatCount()) sort_ = gpu::RadixSort(frame_->device(), strokes->splatCount());
    set_.writeBuffer(0, shared::kPaintingPoints, strokes->points());
    set_.writeBuffer(0, shared::kPaintingPlaced, strokes->placed());
    set_.writeBuffer(0, shared::kPaintingSplats, strokes->splats());
    set_.writeBuffer(0, shared::kPaintingOrder, sort_.values().handle());
    set_.writeBuffer(0, shared::kPaintingKeys, sort_.keys().handle());
  }

  void update(const FrameInput& input) override {
    if (hasLayers_) fins_.update(input);
    if (!isShown_) return;
    uniforms_.write(uniformsOf(input));
    const ExampleTexture& bristles =
        frame_->examples().get(input.look, input.knobs.scene<PaintingParams>().bristles);
    textures_.writeTexture(0, shared::kPaintingBristles, bristles.image.view(),
                           frame_->samplers().get(ExampleTextures::kSampler));
  }

 private:
  static constexpr Aov kAovs[] = {{.name = "painting"}};

  const StrokesOnGpu* strokes() const { return strokesOf(*frame_); }

  void order(VkCommandBuffer commands) const {
    const auto run = [&](const gpu::Pipeline& pipeline, uint32_t count) {
      gpu::computeBarrier(commands);
      pipeline.bind(commands);
      pipeline.bindSet(commands, 0, frame_->frameSet());
      pipeline.bindSet(commands, 1, set_[0]);
      pipeline.push(commands, count);
      constexpr uint32_t kThreads = shared::kPaintingThreads;
      gpu::dispatch(commands, (count + kThreads - 1) / kThreads);
    };
    run(keysPipeline_, strokes()->splatCount());
    sort_.record(commands, strokes()->splatCount());
  }

  // Without either, whoever asks for paint gets none.
  bool hasSplatStep() const { return isShown_ || !hasLayers_; }

  void recordSplats(VkCommandBuffer commands) const {
    gpu::drawViews(commands, configuration_.views(), targets(gpu::Target::Before::cleared), nullptr,
                   [&](uint32_t firstView) {
                     if (isShown_) drawSplats(commands, firstView);
                   });
  }
  void recordLayers(VkCommandBuffer commands) const {
    const gpu::Target::Before before =
        hasSplatStep() ? gpu::Target::Before::kept : gpu::Target::Before::cleared;
    fins_.draw(commands, *resources_, targets(before));
  }

  void declareImages(FrameBuilder& frame) {
    paint_.declare(frame, "painting", formats()[0]);
    if (hasDistance_) distance_.declare(frame, "distance of paint", formats()[1]);
  }
  std::vector<gpu::Target> targets(gpu::Target::Before before) const {
    std::vector<gpu::Target> targets{paint_.target(*resources_, {}, before)};
    if (hasDistance_) targets.push_back(distance_.target(*resources_, {}, before));
    return targets;
  }

  // Of paint, and its distance. Many thin splats add up; layers of paint are few, and bytes already.
  std::vector<VkFormat> formats() const {
    std::vector<VkFormat> formats{isShown_ ? kHalves : kBytes};
    if (hasDistance_) formats.push_back(kHalves);
    return formats;
  }

  void drawSplats(VkCommandBuffer commands, uint32_t firstView) const {
    drawPipeline_.bind(commands);
    drawPipeline_.bindSet(commands, 0, frame_->frameSet());
    drawPipeline_.bindSet(commands, 1, set_[0]);
    drawPipeline_.bindSet(commands, 2, textures_[0]);
    drawPipeline_.push(commands, firstView);
    vkCmdDraw(commands, 6 * strokes()->splatCount(), 1, 0, 0);
  }

  FrameBuilder* frame_ = nullptr;
  Configuration configuration_;
  bool isShown_ = false, hasLayers_ = false, takesLight_ = false, hasDistance_ = false;
  Fins fins_;
  UniformSlice uniforms_;
  gpu::Handle order_, depth_, shadowMap_;
  DrawnImage paint_, distance_;
  const gpu::GraphResources* resources_ = nullptr;
  gpu::SetLayout layout_, textureLayout_;
  gpu::DescriptorSets set_, textures_;
  gpu::Pipeline keysPipeline_, drawPipeline_;
  gpu::RadixSort sort_;
};

}  // namespace

std::unique_ptr<Pass> makeSplats() {
  return std::make_unique<Splats>();
}

}  // namespace scumble::painting
