#include "renderer/deliver.h"

#include "shaders/deliver_depth_frag.h"
#include "shaders/deliver_frag.h"
#include "shaders/deliver_motion_frag.h"
#include "shaders/fullscreen_vert.h"

namespace scumble::renderer {

bool isTargetFormat(VkFormat format, const std::string& aov) {
  switch (format) {
    case VK_FORMAT_R8G8B8A8_UNORM:
    case VK_FORMAT_B8G8R8A8_UNORM:
    case VK_FORMAT_R8G8B8A8_SRGB:
    case VK_FORMAT_B8G8R8A8_SRGB:
      return aov.empty();
    case VK_FORMAT_R16G16B16A16_SFLOAT:
    case VK_FORMAT_R32G32B32A32_SFLOAT:
      return true;
    case VK_FORMAT_D32_SFLOAT:
      return aov == "depth";
    default:
      return false;
  }
}

void Deliver::declare(FrameBuilder& frame, const TargetKey& key, gpu::Handle source, bool isSquareRoot,
                      gpu::Handle& target, bool keepsTarget) {
  key_ = key;
  isSquareRoot_ = isSquareRoot;
  keepsTarget_ = keepsTarget;
  frame.step("deliver", [this](VkCommandBuffer commands) { record(commands); });
  source_ = frame.use(source, gpu::Use::sampledByFragment);
  target_ = target = frame.use(target, key.isDepthBuffer() ? gpu::Use::depthTarget : gpu::Use::colorTarget);
}

void Deliver::create(FrameBuilder& frame) {
  frame_ = &frame;
  layout_ = gpu::SetLayout(frame.device(),
                           {{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT}});
  set_ = gpu::DescriptorSets(frame.device(), layout_);
  gpu::GraphicsPipelineDesc desc;
  desc.vertex = {shaders::fullscreen_vert};
  if (key_.isDepthBuffer()) {
    desc.fragment = {shaders::deliver_depth_frag};
    desc.depthFormat = key_.format;
    desc.depthCompare = VK_COMPARE_OP_ALWAYS;
  } else if (key_.isDeviceMotion()) {
    desc.fragment = {shaders::deliver_motion_frag};
    desc.constants = {key_.motion == MotionUnit::ndcUpwards};
    desc.colorFormats = {key_.format};
  } else {
    desc.fragment = {shaders::deliver_frag};
    const bool encodes = key_.format == VK_FORMAT_R8G8B8A8_UNORM || key_.format == VK_FORMAT_B8G8R8A8_UNORM;
    desc.constants = {encodes, isSquareRoot_};
    desc.colorFormats = {key_.format};
  }
  // How motion is counted is the frame's affair.
  if (key_.isDeviceMotion()) desc.sets = {frame.frameLayout().handle()};
  desc.sets.push_back(layout_.handle());
  desc.pushConstantBytes = 12;
  pipeline_ = gpu::Pipeline(frame.device(), desc);
}

void Deliver::bind(const gpu::GraphResources& resources) {
  resources_ = &resources;
  set_.rewriteTexture(0, 0, resources.image(source_).view(), frame_->samplers().get({VK_FILTER_NEAREST}));
}

void Deliver::record(VkCommandBuffer commands) const {
  const bool isDepth = key_.isDepthBuffer();
  VkRenderingAttachmentInfo attachment{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  attachment.imageView = resources_->image(target_).viewFrom(key_.layer);
  attachment.imageLayout =
      isDepth ? VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  attachment.loadOp = keepsTarget_ ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  const gpu::ImageDesc& size = resources_->image(source_).desc();
  const VkRect2D rectangle{{key_.x, key_.y}, {size.width, size.height}};
  VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
  info.renderArea = rectangle;
  info.layerCount = 1;
  info.colorAttachmentCount = isDepth ? 0 : 1;
  info.pColorAttachments = isDepth ? nullptr : &attachment;
  info.pDepthAttachment = isDepth ? &attachment : nullptr;
  vkCmdBeginRendering(commands, &info);
  const VkViewport viewport{float(key_.x), float(key_.y), float(size.width), float(size.height), 0, 1};
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &rectangle);
  pipeline_.bind(commands);
  if (key_.isDeviceMotion()) pipeline_.bindSet(commands, 0, frame_->frameSet());
  pipeline_.bindSet(commands, key_.isDeviceMotion() ? 1 : 0, set_[0]);
  pipeline_.push(commands, {key_.view, uint32_t(key_.x), uint32_t(key_.y)});
  vkCmdDraw(commands, 3, 1, 0, 0);
  vkCmdEndRendering(commands);
}

}  // namespace scumble::renderer
