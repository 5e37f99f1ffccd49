// Places the points of strokes in the world, and draws their shadows into the shadow map.
#include <algorithm>
#include <cstring>

#include "features/painting/painting.h"
#include "features/painting/painting_knobs.h"
#include "features/painting/strokes_on_gpu.h"
#include "features/painting/uniforms.h"
#include "gpu/dispatch.h"
#include "shaders/painting_points_comp.h"
#include "shaders/painting_shadow_frag.h"
#include "shaders/painting_shadow_vert.h"
#include "shading/geometry_constants.shared.h"
#include "stage/light.h"

namespace scumble::painting {

using namespace frame;

namespace {

class Points : public Pass {
 public:
  const char* name() const override { return "painting-points"; }
  uint32_t variant(const scene::SceneData& scene, const look::LookData& look) const override {
    return drawnPaintings(scene, look);
  }

  void declare(FrameBuilder& frame, uint32_t variant) override {
    paintings_ = variant;
    if (paintings_ == 0) return;
    frame.step(name(), [this](VkCommandBuffer commands) { place(commands); });
    frame.use(frame.get(kVertices), gpu::Use::storageBufferRead);
    const gpu::Handle placed =
        frame.use(frame.graph().importBuffer("painting points"), gpu::Use::storageBufferWrite);
    frame.give(kPlacedPoints, placed);
    frame.addCaster({[this](VkCommandBuffer commands) { drawShadows(commands); },
                     [this] { return version_; },
                     {{placed, gpu::Use::storageBufferReadByVertex}}});
  }

  void create(FrameBuilder& frame) override {
    frame_ = &frame;
    if (paintings_ == 0) return;
    uniforms_ = frame.uniform(sizeof(shared::PaintingUniforms));
    matrices_ = frame.uniform(paintings_ * sizeof(glm::mat4));
    constexpr VkShaderStageFlags kStages = VK_SHADER_STAGE_COMPUTE_BIT | VK_SHADER_STAGE_VERTEX_BIT;
    std::vector<gpu::Binding> bindings(shared::kPaintingBindings,
                                       {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kStages});
    bindings[shared::kPaintingBlock] = {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kStages};
    layout_ = gpu::SetLayout(frame.device(), std::move(bindings));
    set_ = gpu::DescriptorSets(frame.device(), layout_);
    set_.writeBuffer(0, shared::kPaintingBlock, uniforms_.buffer, uniforms_.offset, uniforms_.size);
    set_.writeBuffer(0, shared::kPaintingMatrices, matrices_.buffer, matrices_.offset, matrices_.size);

    gpu::ComputePipelineDesc compute;
    compute.sets = {frame.frameLayout().handle(), layout_.handle()};
    compute.pushConstantBytes = 4;
    compute.constants.resize(size_t(shared::kViewCountId) + 1);
    compute.constants.back() = frame.configuration().viewCount;
    compute.shader = {shaders::painting_points_comp};
    placePipeline_ = gpu::Pipeline(frame.device(), compute);

    gpu::GraphicsPipelineDesc shadow;
    shadow.vertex = {shaders::painting_shadow_vert};
    shadow.fragment = {shaders::painting_shadow_frag};
    shadow.constants = compute.constants;
    shadow.depthFormat = kDepthFormat;
    shadow.depthCompare = VK_COMPARE_OP_LESS;
    shadow.sets = compute.sets;
    shadowPipeline_ = gpu::Pipeline(frame.device(), shadow);
  }

  void bind(const gpu::GraphResources&) override {
    const StrokesOnGpu* const strokes = paintings_ > 0 ? strokesOf(*frame_) : nullptr;
    if (!strokes || strokes->pointCount() == 0) return;
    set_.writeBuffer(0, shared::kPaintingPoints, strokes->points());
    set_.writeBuffer(0, shared::kPaintingPlaced, strokes->placed());
    set_.writeBuffer(0, shared::kPaintingVertices, frame_->scene().geometry().finalCore().handle());
    ++version_;
  }

  void update(const FrameInput& input) override {
    if (paintings_ == 0) return;
    const StrokesOnGpu* const strokes = strokesOf(*frame_);
    if (!strokes) return;
    const shared::PaintingUniforms uniforms = uniformsOf(input);
    std::vector<glm::mat4> matrices;
    const SceneMotion& motion = input.scene.motion();
    for (const DrawnPainting& painting : strokes->paintings())
      matrices.push_back(motion.shownAsDrawn()[painting.node]
                             ? scene::instanceToWorld(motion.worldAsDrawn()[painting.node], painting.toNode)
                             : glm::mat4(0.0f));
    // Only these move points or remove them.
    const bool isSame = motion.version() == motionVersion_ && matrices == placedBy_ &&
                        uniforms.width == placedAs_.width && uniforms.opacity == placedAs_.opacity &&
                        uniforms.until == placedAs_.until;
    if (!isSame) ++version_;
    motionVersion_ = motion.version(), placedAs_ = uniforms;
    uniforms_.write(uniforms);
    std::memcpy(matrices_.mapped, matrices.data(), matrices.size() * sizeof(glm::mat4));
    placedBy_ = std::move(matrices);
  }

 private:
  void bindAll(VkCommandBuffer commands, const gpu::Pipeline& pipeline) const {
    pipeline.bind(commands);
    pipeline.bindSet(commands, 0, frame_->frameSet());
    pipeline.bindSet(commands, 1, set_[0]);
  }
  void place(VkCommandBuffer commands) const {
    const uint32_t count = strokesOf(*frame_)->pointCount();
    bindAll(commands, placePipeline_);
    placePipeline_.push(commands, count);
    constexpr uint32_t kThreads = shared::kPaintingThreads;
    gpu::dispatch(commands, (count + kThreads - 1) / kThreads);
  }
  void drawShadows(VkCommandBuffer commands) const {
    bindAll(commands, shadowPipeline_);
    vkCmdDraw(commands, 6 * strokesOf(*frame_)->pointCount(), 1, 0, 0);
  }

  FrameBuilder* frame_ = nullptr;
  uint32_t paintings_ = 0;
  UniformSlice uniforms_, matrices_;
  gpu::SetLayout layout_;
  gpu::DescriptorSets set_;
  gpu::Pipeline placePipeline_, shadowPipeline_;
  // State of the shadows drawn last.
  uint64_t version_ = 0;
  uint32_t motionVersion_ = 0;
  std::vector<glm::mat4> placedBy_;
  shared::PaintingUniforms placedAs_{};
};

}  // namespace

shared::PaintingUniforms uniformsOf(const FrameInput& input) {
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
  return u;
}

std::unique_ptr<Pass> makePoints() {
  return std::make_unique<Points>();
}

}  // namespace scumble::painting
