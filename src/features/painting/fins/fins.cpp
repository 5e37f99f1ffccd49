#include "features/painting/fins/fins.h"

#include "features/painting/fins/painting_fins.shared.h"
#include "features/painting/painting_knobs.h"
#include "shaders/painting_fins_frag.h"
#include "shaders/painting_fins_vert.h"

namespace scumble::painting {

using namespace frame;

void Fins::declare(FrameBuilder& frame) {
  frame.use(frame.get(kVertices), gpu::Use::vertexBuffer);
  frame.use(frame.get(kTransparentOrder), gpu::Use::indexBuffer);
  depth_ = frame.use(frame.get(kDepth), gpu::Use::depthTest);
}

void Fins::create(FrameBuilder& frame, VkFormat format) {
  frame_ = &frame;
  uniforms_ = frame.uniform(sizeof(shared::FinsUniforms));
  layout_ =
      gpu::SetLayout(frame.device(), {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_SHADER_STAGE_FRAGMENT_BIT}});
  set_ = gpu::DescriptorSets(frame.device(), layout_);
  set_.writeBuffer(0, shared::kFinsBlock, uniforms_.buffer, uniforms_.offset, uniforms_.size);
  GeometryStepDesc desc;
  desc.vertex = {shaders::painting_fins_vert};
  desc.fragment = {shaders::painting_fins_frag};
  desc.inputs = kPosition | kNormal | kUv0 | kUv1 | kColor;
  desc.colorFormats = {format};
  desc.viewMask = frame.configuration().views().mask();
  desc.viewCount = frame.configuration().viewCount;
  desc.passLayout = &layout_;
  step_.create(frame, desc, TransparentStep::What::paint);
}

void Fins::draw(VkCommandBuffer commands, const gpu::GraphResources& resources,
                const gpu::Target& paint) const {
  const gpu::Target depth{&resources.image(depth_), nullptr, {}, gpu::Target::Before::tested};
  gpu::drawViews(commands, frame_->configuration().views(), {&paint, 1}, &depth,
                 [&](uint32_t firstView) { step_.draw(commands, &set_, firstView); });
}

void Fins::update(const FrameInput& input) {
  uniforms_.write(shared::FinsUniforms{input.knobs.scene<PaintingParams>().opacity});
  step_.update(0);
}

}  // namespace scumble::painting
