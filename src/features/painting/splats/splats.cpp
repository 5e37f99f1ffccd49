// Places splats, sorts them, and draws them over each other; and layers of paint over those.
#include <bit>

#include "features/painting/fins/fins.h"
#include "features/painting/painting.h"
#include "features/painting/painting_knobs.h"
#include "features/painting/splats/strokes_on_gpu.h"
#include "frame/drawn_image.h"
#include "gpu/dispatch.h"
#include "gpu/prefix_sum.h"
#include "shaders/painting_keys_comp.h"
#include "shaders/painting_points_comp.h"
#include "shaders/painting_splat_frag.h"
#include "shaders/painting_splat_vert.h"
#include "shading/geometry_constants.shared.h"
#include "stage/light.h"

namespace scumble::painting {

using namespace frame;

namespace {

class Splats : public Pass {
 public:
  const char* name() const override { return "painting"; }
  std::span<const Aov> aovs() const override { return kAovs; }
  uint32_t variant(const scene::SceneData& scene, const look::LookData& look) const override {
    // In powers of two, so that few that come and go make nothing anew.
    const uint32_t paintings = shownPaintings(scene, look);
    const bool takesLight = paintings > 0 && look.get<PaintingParams>().light > 0;
    return 4 * (paintings ? std::bit_ceil(paintings) : 0) + 2 * uint32_t(showsLayers(scene, look)) +
           uint32_t(takesLight);
  }

  void declare(FrameBuilder& frame, uint32_t variant) override {
    paintings_ = variant / 4, hasLayers_ = variant & 2, takesLight_ = variant & 1;
    isShown_ = paintings_ > 0;
    configuration_ = frame.configuration();
    if (isShown_) {
      frame.step("painting-order", [this](VkCommandBuffer commands) { order(commands); });
      frame.use(frame.get(kVertices), gpu::Use::storageBufferRead);
      placedBuffer_ = frame.use(frame.graph().importBuffer("painting points"), gpu::Use::storageBufferWrite);
    }
    // Splats sink into what is there, so they read its depth; layers are tested against it, as attachment.
    if (hasSplatStep()) {
      frame.step(name(), [this](VkCommandBuffer commands) { recordSplats(commands); });
      if (isShown_) {
        frame.use(placedBuffer_, gpu::Use::storageBufferReadByVertex);
        depth_ = frame.use(frame.get(kDepth), gpu::Use::sampledByFragment);
        shadowMap_ = frame.use(frame.get(kShadowMap), gpu::Use::sampledByVertex);
      }
      paint_.declare(frame, "painting", format());
    }
    if (hasLayers_) {
      frame.step(name(), [this](VkCommandBuffer commands) { recordLayers(commands); });
      fins_.declare(frame);
      if (hasSplatStep())
        paint_.declareAgain(frame);
      else
        paint_.declare(frame, "painting", format());
    }
    if (isShown_ || hasLayers_) frame.give(kPaint, paint_.image());
    frame.offer(kAovs[0], {paint_.image()});
  }

  void create(FrameBuilder& frame) override {
    frame_ = &frame;
    if (hasLayers_) fins_.create(frame, format());
    if (!isShown_) return;
    uniforms_ = frame.uniform(sizeof(shared::PaintingUniforms));
    matrices_ = frame.uniform(paintings_ * sizeof(glm::mat4));
    constexpr VkShaderStageFlags kPlaces = VK_SHADER_STAGE_COMPUTE_BIT | VK_SHADER_STAGE_VERTEX_BIT;
    std::vector<gpu::Binding> bindings(shared::kPaintingBindings,
                                       {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kPlaces});
    bindings[shared::kPaintingBlock] = {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                                        kPlaces | VK_SHADER_STAGE_FRAGMENT_BIT};
    layout_ = gpu::SetLayout(frame.device(), std::move(bindings));
    set_ = gpu::DescriptorSets(frame.device(), layout_);
    set_.writeBuffer(0, shared::kPaintingBlock, uniforms_.buffer, uniforms_.offset, uniforms_.size);
    set_.writeBuffer(0, shared::kPaintingMatrices, matrices_.buffer, matrices_.offset, matrices_.size);
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
    compute.shader = {shaders::painting_points_comp};
    pointsPipeline_ = gpu::Pipeline(frame.device(), compute);
    compute.shader = {shaders::painting_keys_comp};
    keysPipeline_ = gpu::Pipeline(frame.device(), compute);

    gpu::GraphicsPipelineDesc desc;
    desc.vertex = {shaders::painting_splat_vert};
    desc.fragment = {shaders::painting_splat_frag};
    desc.blend = gpu::Blend::premultiplied;
    desc.constants.resize(size_t(shared::kPassId) + 1);
    desc.constants[size_t(shared::kViewCountId)] = configuration_.viewCount;
    desc.constants[size_t(shared::kPassId)] = takesLight_;
    desc.colorFormats = {kHalves};
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
    const uint64_t placedBytes = strokes->pointCount() * sizeof(shared::PlacedPoint);
    if (placed_.size() < placedBytes)
      placed_ = gpu::Buffer(frame_->device(), placedBytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                            gpu::MemoryKind::device);
    set_.writeBuffer(0, shared::kPaintingPoints, strokes->points());
    set_.writeBuffer(0, shared::kPaintingPlaced, placed_.handle());
    set_.writeBuffer(0, shared::kPaintingSplats, strokes->splats());
    set_.writeBuffer(0, shared::kPaintingOrder, sort_.values().handle());
    set_.writeBuffer(0, shared::kPaintingKeys, sort_.keys().handle());
    set_.writeBuffer(0, shared::kPaintingVertices, frame_->scene().geometry().finalCore().handle());
  }

  void update(const FrameInput& input) override {
    if (hasLayers_) fins_.update(input);
    if (!isShown_) return;
    const PaintingParams params = input.knobs.scene<PaintingParams>();
    const LightParams light = input.knobs.scene<LightParams>();
    const shared::MaterialData& material = input.scene.materialData(0);
    shared::PaintingUniforms u{};
    u.width = params.width, u.opacity = params.opacity, u.spacing = params.spacing;
    u.streaks = params.streaks, u.dryEnds = params.dryEnds, u.variation = params.variation;
    u.order = params.order, u.sunken = params.sunken, u.light = params.light;
    u.until = params.plays ? float(std::min(input.time * double(params.speed), 3e38)) : 3.4e38f;
    u.terminator = light.terminator, u.terminatorSharpness = light.terminatorSharpness;
    u.lit = material.lit, u.shadowed = material.shadowed;
    u.tintDown = material.tintDown, u.tintUp = material.tintUp;
    uniforms_.write(u);
    auto* const matrices = reinterpret_cast<glm::mat4*>(matrices_.mapped);
    const std::vector<glm::mat4>& world = input.scene.motion().worldAsDrawn();
    const std::vector<DrawnPainting>& paintings = strokes()->paintings();
    for (size_t p = 0; p < paintings.size(); ++p)
      matrices[p] = world[paintings[p].node] * paintings[p].toNode;
    const ExampleTexture& bristles = frame_->examples().get(input.look, params.bristles);
    textures_.writeTexture(0, shared::kPaintingBristles, bristles.image.view(),
                           frame_->samplers().get(ExampleTextures::kSampler));
  }

 private:
  static constexpr Aov kAovs[] = {{.name = "painting"}};

  // Null where the scene, as it is now, has none: these passes are about to go then.
  const StrokesOnGpu* strokes() const {
    const auto here = frame_->scene().feature(kName);
    return here ? &static_cast<const PaintingMoment*>(here->moment)->strokes() : nullptr;
  }

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
    run(pointsPipeline_, strokes()->pointCount());
    run(keysPipeline_, strokes()->splatCount());
    sort_.record(commands, strokes()->splatCount());
  }

  // Without either, whoever asks for paint gets none.
  bool hasSplatStep() const { return isShown_ || !hasLayers_; }

  void recordSplats(VkCommandBuffer commands) const {
    const gpu::Target paint = paint_.target(*resources_);
    gpu::drawViews(commands, configuration_.views(), {&paint, 1}, nullptr, [&](uint32_t firstView) {
      if (isShown_) drawSplats(commands, firstView);
    });
  }
  void recordLayers(VkCommandBuffer commands) const {
    const gpu::Target::Before before =
        hasSplatStep() ? gpu::Target::Before::kept : gpu::Target::Before::cleared;
    fins_.draw(commands, *resources_, paint_.target(*resources_, {}, before));
  }

  // Many thin splats add up; layers of paint are few, and bytes already.
  VkFormat format() const { return isShown_ ? kHalves : kBytes; }

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
  uint32_t paintings_ = 0;
  bool isShown_ = false, hasLayers_ = false, takesLight_ = false;
  Fins fins_;
  UniformSlice uniforms_, matrices_;
  gpu::Handle placedBuffer_, depth_, shadowMap_;
  DrawnImage paint_;
  const gpu::GraphResources* resources_ = nullptr;
  gpu::SetLayout layout_, textureLayout_;
  gpu::DescriptorSets set_, textures_;
  gpu::Pipeline pointsPipeline_, keysPipeline_, drawPipeline_;
  gpu::RadixSort sort_;
  gpu::Buffer placed_;
};

}  // namespace

std::unique_ptr<Pass> makeSplats() {
  return std::make_unique<Splats>();
}

}  // namespace scumble::painting
