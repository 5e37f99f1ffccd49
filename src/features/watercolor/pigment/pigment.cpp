// Lays pigment down around anchors.
#include "features/watercolor/pigment/anchors_on_gpu.h"
#include "features/watercolor/watercolor.h"
#include "features/watercolor/watercolor_knobs.h"
#include "frame/pass.h"
#include "shaders/pigment_stamp_cells_frag.h"
#include "shaders/pigment_stamp_frag.h"
#include "shaders/pigment_stamp_shapes_frag.h"
#include "shaders/pigment_stamp_vert.h"
#include "shading/geometry_constants.shared.h"

namespace scumble::watercolor {

using namespace frame;

namespace {

enum Generator : uint32_t { kStamps, kShapes, kCells };

class Pigment : public Pass {
 public:
  const char* name() const override { return "pigment"; }
  std::span<const Aov> aovs() const override { return kAovs; }
  uint32_t variant(const scene::SceneData&, const look::LookData& look) const override {
    return mayShow(look) ? 1 + uint32_t(look.get<WatercolorParams>().generator) : 0;
  }

  void declare(FrameBuilder& frame, uint32_t variant) override {
    isShown_ = variant > 0;
    generator_ = isShown_ ? variant - 1 : kStamps;
    configuration_ = frame.configuration();
    frame.step(name(), [this](VkCommandBuffer commands) { record(commands); });
    if (isShown_) {
      frame.use(frame.get(kVertices), gpu::Use::storageBufferReadByVertex);
      depth_ = frame.use(frame.get(kDepth), gpu::Use::sampledByFragment);
    }
    gpu::ImageShape shape{.format = kBytes, .overX = shared::kPigmentScale, .overY = shared::kPigmentScale};
    image_ = frame.use(frame.image("pigment", shape), gpu::Use::colorTarget);
    shape.format = kDepthFormat;
    if (generator_ == kCells) cells_ = frame.use(frame.image("pigment cells", shape), gpu::Use::depthTarget);
    frame.give(kPigment, image_);
    frame.offer(kAovs[0], {image_});
  }

  void create(FrameBuilder& frame) override {
    frame_ = &frame;
    if (!isShown_) return;  // whoever asks for it gets none
    uniforms_ = frame.uniform(sizeof(shared::PigmentUniforms));
    constexpr VkShaderStageFlags kVertex = VK_SHADER_STAGE_VERTEX_BIT,
                                 kFragment = VK_SHADER_STAGE_FRAGMENT_BIT;
    layout_ = gpu::SetLayout(frame.device(), {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kVertex | kFragment},
                                              {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex},
                                              {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex},
                                              {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kVertex},
                                              {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kFragment},
                                              {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kFragment}});
    set_ = gpu::DescriptorSets(frame.device(), layout_);
    set_.writeBuffer(0, shared::kPigmentBlock, uniforms_.buffer, uniforms_.offset, uniforms_.size);
    gpu::GraphicsPipelineDesc desc;
    desc.vertex = {shaders::pigment_stamp_vert};
    if (generator_ == kCells) {
      desc.fragment = {shaders::pigment_stamp_cells_frag};
      desc.depthFormat = kDepthFormat;
      desc.depthCompare = VK_COMPARE_OP_GREATER;
    } else {
      if (generator_ == kShapes)
        desc.fragment = {shaders::pigment_stamp_shapes_frag};
      else
        desc.fragment = {shaders::pigment_stamp_frag};
      desc.blend = gpu::Blend::over;
    }
    desc.constants.resize(size_t(shared::kViewCountId) + 1);
    desc.constants.back() = configuration_.viewCount;
    desc.colorFormats = {kBytes};
    desc.viewMask = configuration_.views().mask();
    desc.sets = {frame.frameLayout().handle(), layout_.handle()};
    desc.pushConstantBytes = 4;
    pipeline_ = gpu::Pipeline(frame.device(), desc);
  }

  void bind(const gpu::GraphResources& resources) override {
    resources_ = &resources;
    if (!isShown_) return;
    set_.rewriteTexture(0, shared::kPigmentDepth, resources.image(depth_).view(),
                        frame_->samplers().get({VK_FILTER_NEAREST}));
    if (chunkCount() == 0) return;
    set_.writeBuffer(0, shared::kPigmentAnchors, anchors()->anchors());
    set_.writeBuffer(0, shared::kPigmentChunks, anchors()->chunks());
    set_.writeBuffer(0, shared::kPigmentVertices, frame_->scene().geometry().finalCore().handle());
  }

  void update(const FrameInput& input) override {
    if (!isShown_) return;
    const WatercolorParams params = input.knobs.scene<WatercolorParams>();
    uniforms_.write(shared::PigmentUniforms{params.spacing * input.uniforms.pixelScale, params.stampSize,
                                            params.backruns});
    const ExampleTexture& brush = frame_->examples().get(input.look, params.brush);
    set_.writeTexture(0, shared::kPigmentBrush, brush.image.view(), frame_->samplers().get(kBrushSampler));
  }

 private:
  static constexpr Aov kAovs[] = {{.name = "pigment"}};
  static constexpr gpu::SamplerDesc kBrushSampler{
      VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_REPEAT, true, false, 1};

  // Null where the scene, as it is now, is no watercolour.
  const AnchorsOnGpu* anchors() const {
    const auto here = frame_->scene().feature(kName);
    return here ? &static_cast<const WatercolorMoment*>(here->moment)->anchors() : nullptr;
  }
  uint32_t chunkCount() const { return anchors() ? anchors()->chunkCount() : 0; }

  void record(VkCommandBuffer commands) const {
    gpu::Target pigment{&resources_->image(image_), nullptr, {}};
    pigment.clear.color = {{0.5f, 0.5f, 0.5f, 0.0f}};
    gpu::Target cells;
    if (generator_ == kCells) cells = {&resources_->image(cells_), nullptr, {}};
    gpu::drawViews(commands, configuration_.views(), {&pigment, 1}, generator_ == kCells ? &cells : nullptr,
                   [&](uint32_t firstView) {
                     if (!isShown_ || chunkCount() == 0) return;
                     pipeline_.bind(commands);
                     pipeline_.bindSet(commands, 0, frame_->frameSet());
                     pipeline_.bindSet(commands, 1, set_[0]);
                     pipeline_.push(commands, firstView);
                     vkCmdDraw(commands, 6 * shared::kAnchorChunk * chunkCount(), 1, 0, 0);
                   });
  }

  FrameBuilder* frame_ = nullptr;
  Configuration configuration_;
  bool isShown_ = false;
  uint32_t generator_ = kStamps;
  UniformSlice uniforms_;
  gpu::Handle depth_, image_, cells_;
  const gpu::GraphResources* resources_ = nullptr;
  gpu::SetLayout layout_;
  gpu::DescriptorSets set_;
  gpu::Pipeline pipeline_;
};

}  // namespace

std::unique_ptr<Pass> makePigment() {
  return std::make_unique<Pigment>();
}

}  // namespace scumble::watercolor
