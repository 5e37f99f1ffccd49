#include "frame/pass.h"

#include <algorithm>
#include <cassert>

namespace scumble::frame {

FrameBuilder::FrameBuilder(gpu::Device& device, gpu::Samplers& samplers, ExampleTextures& examples,
                           const Configuration& configuration, const SceneOnGpu& scene,
                           UniformSlice uniformMemory)
    : device_(device),
      samplers_(samplers),
      examples_(examples),
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
    id = graph_.addImage(info.name, desc);
  }
  return id;
}

gpu::ResourceId FrameBuilder::multisampled(Slot slot) {
  assert(slotInfo(slot).multisampled && configuration_.samples > 1);
  gpu::ResourceId& id = multisampled_[size_t(slot)];
  if (id == kNone) {
    const SlotInfo& info = slotInfo(slot);
    id = graph_.addImage(std::string(info.name) + " samples",
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

namespace {

void beginRendering(VkCommandBuffer commands, uint32_t firstLayer, uint32_t mask,
                    std::span<const Target> colors, const Target* depth) {
  const auto attachment = [&](const Target& target, VkImageLayout layout, VkResolveModeFlagBits resolveMode) {
    static constexpr VkAttachmentLoadOp kLoad[] = {
        VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_LOAD_OP_LOAD};
    VkRenderingAttachmentInfo info{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    info.imageView = target.image->viewFrom(firstLayer);
    info.imageLayout = layout;
    info.loadOp = kLoad[size_t(target.before)];
    info.storeOp = target.resolve ? VK_ATTACHMENT_STORE_OP_DONT_CARE : VK_ATTACHMENT_STORE_OP_STORE;
    info.clearValue = target.clear;
    if (target.resolve) {
      info.resolveMode = resolveMode;
      info.resolveImageView = target.resolve->viewFrom(firstLayer);
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

  const gpu::ImageDesc& size = (depth ? depth : &colors[0])->image->desc();
  VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
  info.renderArea = {{0, 0}, {size.width, size.height}};
  info.layerCount = 1;
  info.viewMask = mask;
  info.colorAttachmentCount = uint32_t(colorInfos.size());
  info.pColorAttachments = colorInfos.data();
  info.pDepthAttachment = depth ? &depthInfo : nullptr;
  vkCmdBeginRendering(commands, &info);
  const VkViewport viewport{0, 0, float(size.width), float(size.height), 0, 1};
  const VkRect2D scissor{{0, 0}, {size.width, size.height}};
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &scissor);
}

}  // namespace

uint32_t viewMask(const Configuration& configuration) {
  return configuration.multiview ? (1u << configuration.viewCount) - 1 : 1;
}

void drawViews(VkCommandBuffer commands, const Configuration& configuration, std::span<const Target> colors,
               const Target* depth, const std::function<void(uint32_t firstView)>& draw) {
  const bool resolves = std::any_of(colors.begin(), colors.end(), [](const Target& t) { return t.resolve; });
  const bool together = configuration.multiview || configuration.viewCount == 1;
  if (together || !resolves) {
    for (uint32_t view = 0; view < (together ? 1 : configuration.viewCount); ++view) {
      beginRendering(commands, view, viewMask(configuration), colors, depth);
      draw(view);
      vkCmdEndRendering(commands);
    }
    return;
  }
  // The driver that needs its views one by one also resolves into the first layer only, whatever layer it is
  // given. So the samples are kept, and all layers resolved at once by a rendering that draws nothing.
  std::vector<Target> kept(colors.begin(), colors.end());
  Target keptDepth = depth ? *depth : Target{};
  for (Target& target : kept) target.resolve = nullptr;
  keptDepth.resolve = nullptr;
  for (uint32_t view = 0; view < configuration.viewCount; ++view) {
    beginRendering(commands, view, 1, kept, depth ? &keptDepth : nullptr);
    draw(view);
    vkCmdEndRendering(commands);
  }
  kept.assign(colors.begin(), colors.end());
  for (Target& target : kept) target.before = Target::Before::kept;
  keptDepth = depth ? *depth : Target{};
  keptDepth.before = Target::Before::kept;
  constexpr VkPipelineStageFlags2 kStages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT |
                                            VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT |
                                            VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT;
  constexpr VkAccessFlags2 kWrites =
      VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  constexpr VkAccessFlags2 kReads =
      VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT;
  gpu::memoryBarrier(commands, kStages, kWrites, kStages, kWrites | kReads);
  beginRendering(commands, 0, (1u << configuration.viewCount) - 1, kept, depth ? &keptDepth : nullptr);
  vkCmdEndRendering(commands);
}

void drawOnce(VkCommandBuffer commands, const Target& depth, const std::function<void()>& draw) {
  beginRendering(commands, 0, 0, {}, &depth);
  draw();
  vkCmdEndRendering(commands);
}

}  // namespace scumble::frame
