#include "frame/pass.h"

#include <cassert>

namespace scumble::frame {

FrameBuilder::FrameBuilder(gpu::Device& device, gpu::Samplers& samplers, const Configuration& configuration,
                           const SceneOnGpu& scene, UniformSlice uniformMemory)
    : device_(device),
      samplers_(samplers),
      configuration_(configuration),
      scene_(scene),
      uniformMemory_(uniformMemory),
      slots_(size_t(Slot::count), kNone),
      multisampled_(size_t(Slot::count), kNone),
      finalVertices_(graph_.addBuffer("final vertices")) {}

gpu::ResourceId FrameBuilder::slot(Slot slot) {
  gpu::ResourceId& id = slots_[size_t(slot)];
  if (id == kNone) {
    const SlotInfo& info = slotInfo(slot);
    gpu::ImageDesc desc{info.format, configuration_.width, configuration_.height, 1};
    if (slot == Slot::shadowMap) desc.width = desc.height = kShadowMapSize;
    if (slot == Slot::blur) desc.width = (desc.width + 3) / 4, desc.height = (desc.height + 3) / 4;
    if (info.rate == Rate::perView) desc.layers = configuration_.viewCount;
    id = graph_.addImage(info.aov, desc);
  }
  return id;
}

gpu::ResourceId FrameBuilder::multisampled(Slot slot) {
  assert(slotInfo(slot).multisampled && configuration_.samples > 1);
  gpu::ResourceId& id = multisampled_[size_t(slot)];
  if (id == kNone) {
    const SlotInfo& info = slotInfo(slot);
    id = graph_.addImage(std::string(info.aov) + " samples",
                         {info.format, configuration_.width, configuration_.height, configuration_.viewCount,
                          1, configuration_.samples});
  }
  return id;
}

void FrameBuilder::addStep(const std::string& name, std::vector<gpu::ResourceUse> uses, Record record) {
  graph_.addStep(name, std::move(uses));
  records_.push_back(std::move(record));
}

UniformSlice FrameBuilder::uniform(uint64_t bytes) {
  constexpr uint64_t kAlignment = 256;  // no device asks for more
  const UniformSlice slice{uniformMemory_.buffer, uniformMemory_.offset + uniformUsed_, bytes,
                           uniformMemory_.mapped + uniformUsed_};
  uniformUsed_ += (bytes + kAlignment - 1) / kAlignment * kAlignment;
  assert(uniformUsed_ <= uniformMemory_.size);
  return slice;
}

FrameResources::FrameResources(gpu::Device& device, const FrameBuilder& builder,
                               const gpu::SetLayout& frameLayout, VkDescriptorSet frameSet)
    : frameLayout_(frameLayout), frameSet_(frameSet) {
  for (const gpu::FrameGraph::ResourceInfo& resource : builder.graph().resources()) {
    if (resource.isImage && resource.usage != 0)
      images_.emplace_back(device, resource.desc, resource.usage);
    else
      images_.emplace_back();
  }
}

RenderingScope::RenderingScope(VkCommandBuffer commands, uint32_t width, uint32_t height, uint32_t viewMask,
                               std::span<const Target> colors, const Target* depth)
    : commands_(commands) {
  const auto attachment = [](const Target& target, VkImageLayout layout, VkResolveModeFlagBits resolveMode) {
    VkRenderingAttachmentInfo info{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    info.imageView = target.image->view();
    info.imageLayout = layout;
    info.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    info.storeOp = target.resolve ? VK_ATTACHMENT_STORE_OP_DONT_CARE : VK_ATTACHMENT_STORE_OP_STORE;
    info.clearValue = target.clear;
    if (target.resolve) {
      info.resolveMode = resolveMode;
      info.resolveImageView = target.resolve->view();
      info.resolveImageLayout = layout;
    }
    return info;
  };
  std::vector<VkRenderingAttachmentInfo> colorInfos;
  for (const Target& color : colors)
    colorInfos.push_back(
        attachment(color, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_RESOLVE_MODE_AVERAGE_BIT));
  VkRenderingAttachmentInfo depthInfo;
  if (depth)
    depthInfo = attachment(*depth, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, VK_RESOLVE_MODE_SAMPLE_ZERO_BIT);

  VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
  info.renderArea = {{0, 0}, {width, height}};
  info.layerCount = 1;
  info.viewMask = viewMask;
  info.colorAttachmentCount = uint32_t(colorInfos.size());
  info.pColorAttachments = colorInfos.data();
  info.pDepthAttachment = depth ? &depthInfo : nullptr;
  vkCmdBeginRendering(commands, &info);
  const VkViewport viewport{0, 0, float(width), float(height), 0, 1};
  const VkRect2D scissor{{0, 0}, {width, height}};
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &scissor);
}

}  // namespace scumble::frame
