#include "features/painting/fins/fins.h"

#include "features/painting/fins/painting_fins.shared.h"
#include "features/painting/painting_knobs.h"
#include "shaders/painting_fins_distance_frag.h"
#include "shaders/painting_fins_frag.h"
#include "shaders/painting_fins_vert.h"

namespace scumble::painting {

using namespace frame;

void Fins::declare(FrameBuilder& frame) {
  frame.use(frame.get(kVertices), gpu::Use::vertexBuffer);
  frame.use(frame.get(kTransparentOrder), gpu::Use::indexBuffer);
  depth_ = frame.use(frame.get(kDepth), gpu::Use::depthTest);
}

void Fins::create(FrameBuilder& frame, const std::vector<VkFormat>& formats) {
  frame_ = &frame;
  uniforms_ = frame.uniform(sizeof(shared::FinsUniforms));
  layout_ =
      gpu::SetLayout(frame.device(), {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_SHADER_STAGE_FRAGMENT_BIT}});
  set_ = gpu::DescriptorSets(frame.device(), layout_);
  set_.writeBuffer(0, shared::kFinsBlock, uniforms_.buffer, uniforms_.offset, uniforms_.size);
  GeometryStepDesc desc;
  desc.vertex = {shaders::painting_fins_vert};
  if (formats.size() > 1)
    desc.fragment = {shaders::painting_fins_distance_frag};
  else
    desc.fragment = {shaders::painting_fins_frag};
  desc.inputs = kPosition | kNormal | kUv0 | kUv1 | kColor;
  desc.colorFormats = formats;
  desc.viewMask = frame.configuration().views().mask();
  desc.viewCount = frame.configuration().viewCount;
  desc.passLayout = &layout_;
  step_.create(frame, desc, TransparentStep::What::paint);
}

void Fins::draw(VkCommandBuffer commands, const gpu::GraphResources& resources,
                std::span<const gpu::Target> targets) const {
  const gpu::Target depth{&resources.image(depth_), nullptr, {}, gpu::Target::Before::tested};
  gpu::drawViews(commands, frame_->configuration().views(), targets, &depth,
                 [&](uint32_t firstView) { step_.draw(commands, &set_, firstView); });
}

void Fins::update(const FrameInput& input) {
  uniforms_.write(shared::FinsUniforms{input.knobs.scene<PaintingParams>().opacity});
  step_.update(0);
}

}  // namespace scumble::painting
