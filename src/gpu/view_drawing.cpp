#include "gpu/view_drawing.h"

#include <algorithm>
#include <vector>

namespace scumble::gpu {

namespace {

void beginRendering(VkCommandBuffer commands, uint32_t firstLayer, uint32_t mask,
                    std::span<const Target> colors, const Target* depth) {
  const auto attachment = [&](const Target& target, VkImageLayout layout, VkResolveModeFlagBits resolveMode) {
    static constexpr VkAttachmentLoadOp kLoad[] = {VK_ATTACHMENT_LOAD_OP_CLEAR,
                                                   VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                                                   VK_ATTACHMENT_LOAD_OP_LOAD, VK_ATTACHMENT_LOAD_OP_LOAD};
    VkRenderingAttachmentInfo info{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    info.imageView = target.image->viewFrom(firstLayer);
    info.imageLayout = layout;
    info.loadOp = kLoad[size_t(target.before)];
    if (target.before == Target::Before::tested)
      info.storeOp = VK_ATTACHMENT_STORE_OP_NONE;
    else
      info.storeOp = target.resolve && !target.keepsSamples ? VK_ATTACHMENT_STORE_OP_DONT_CARE
                                                            : VK_ATTACHMENT_STORE_OP_STORE;
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
    depthInfo = attachment(*depth,
                           depth->before == Target::Before::tested ? VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL
                                                                   : VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
                           VK_RESOLVE_MODE_SAMPLE_ZERO_BIT);

  const ImageDesc& size = (depth ? depth : &colors[0])->image->desc();
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

void drawViews(VkCommandBuffer commands, const Views& views, std::span<const Target> colors,
               const Target* depth, const std::function<void(uint32_t firstView)>& draw) {
  const bool resolves = std::any_of(colors.begin(), colors.end(), [](const Target& t) { return t.resolve; });
  const bool together = views.drawing == ViewDrawing::together || views.count == 1;
  if (together || !resolves || views.drawing == ViewDrawing::separately) {
    for (uint32_t view = 0; view < (together ? 1 : views.count); ++view) {
      beginRendering(commands, view, views.mask(), colors, depth);
      draw(view);
      vkCmdEndRendering(commands);
    }
    return;
  }
  // All layers are resolved by a rendering of all views that draws nothing.
  std::vector<Target> kept(colors.begin(), colors.end());
  Target keptDepth = depth ? *depth : Target{};
  for (Target& target : kept) target.resolve = nullptr;
  keptDepth.resolve = nullptr;
  for (uint32_t view = 0; view < views.count; ++view) {
    beginRendering(commands, view, 1, kept, depth ? &keptDepth : nullptr);
    draw(view);
    vkCmdEndRendering(commands);
  }
  kept.assign(colors.begin(), colors.end());
  for (Target& target : kept) target.before = Target::Before::kept;
  keptDepth = depth ? *depth : Target{};
  if (keptDepth.before != Target::Before::tested) keptDepth.before = Target::Before::kept;
  constexpr VkPipelineStageFlags2 kStages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT |
                                            VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT |
                                            VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT;
  constexpr VkAccessFlags2 kWrites =
      VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  constexpr VkAccessFlags2 kReads =
      VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT;
  memoryBarrier(commands, kStages, kWrites, kStages, kWrites | kReads);
  beginRendering(commands, 0, (1u << views.count) - 1, kept, depth ? &keptDepth : nullptr);
  vkCmdEndRendering(commands);
}

void drawOnce(VkCommandBuffer commands, std::span<const Target> colors, const Target* depth,
              const std::function<void()>& draw) {
  beginRendering(commands, 0, 0, colors, depth);
  draw();
  vkCmdEndRendering(commands);
}

}  // namespace scumble::gpu
