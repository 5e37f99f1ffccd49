#include "gpu/frame_graph.h"

#include <algorithm>
#include <cassert>

namespace scumble::gpu {

UseInfo useInfo(Use use) {
  constexpr VkPipelineStageFlags2 kDepthStages =
      VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
  constexpr VkPipelineStageFlags2 kColorStage = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
  constexpr VkAccessFlags2 kColorAccess =
      VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
  constexpr VkAccessFlags2 kDepthAccess =
      VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  switch (use) {
    case Use::sampledByFragment:
      return {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
              VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_IMAGE_USAGE_SAMPLED_BIT, false};
    case Use::sampledByCompute:
      return {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
              VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_IMAGE_USAGE_SAMPLED_BIT, false};
    case Use::colorTarget:
    case Use::resolveTarget:
      return {kColorStage, kColorAccess, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
              VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, true};
    case Use::depthTarget:
      return {kDepthStages, kDepthAccess, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
              VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, true};
    case Use::depthResolveTarget:
      // A depth resolve happens in the colour output stage (Vulkan 1.3, section 8.3.4).
      return {kColorStage | kDepthStages, kColorAccess | kDepthAccess,
              VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, true};
    case Use::storageImageWrite:
      return {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
              VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_USAGE_STORAGE_BIT, true};
    case Use::storageBufferRead:
      return {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT,
              VK_IMAGE_LAYOUT_UNDEFINED, 0, false};
    case Use::storageBufferWrite:
      return {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
              VK_IMAGE_LAYOUT_UNDEFINED, 0, true};
    case Use::vertexBuffer:
      return {VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT, VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT,
              VK_IMAGE_LAYOUT_UNDEFINED, 0, false};
    case Use::copySource:
      return {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
              VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_IMAGE_USAGE_TRANSFER_SRC_BIT, false};
  }
  assert(!"an unknown use");
  return {};
}

ResourceId FrameGraph::addImage(std::string name, const ImageDesc& desc) {
  resources_.push_back({std::move(name), true, desc});
  return ResourceId(resources_.size() - 1);
}

ResourceId FrameGraph::addBuffer(std::string name) {
  resources_.push_back({std::move(name), false, {}});
  return ResourceId(resources_.size() - 1);
}

size_t FrameGraph::addStep(std::string name, std::vector<ResourceUse> uses) {
  for (size_t i = 0; i < uses.size(); ++i) {
    const ResourceId resource = uses[i].resource;
    assert(resource < resources_.size());
    const auto sameResource = [&](const ResourceUse& other) { return other.resource == resource; };
    assert(std::none_of(uses.begin(), uses.begin() + long(i), sameResource) &&
           "a resource is used twice in one step");
    const UseInfo info = useInfo(uses[i].use);
    assert(resources_[resource].isImage == (info.layout != VK_IMAGE_LAYOUT_UNDEFINED));
    assert((info.writes || std::any_of(steps_.begin(), steps_.end(),
                                       [&](const Step& step) {
                                         return std::any_of(step.uses.begin(), step.uses.end(), sameResource);
                                       })) &&
           "a resource is read before it was written");
    resources_[resource].usage |= info.imageUsage;
  }
  steps_.push_back({std::move(name), std::move(uses)});
  return steps_.size() - 1;
}

std::vector<std::vector<Barrier>> FrameGraph::planBarriers() const {
  // What has to be waited for before the next use of a resource.
  struct State {
    VkPipelineStageFlags2 writeStages = 0, readStages = 0;  // since the last barrier
    VkAccessFlags2 writeAccess = 0;
    VkPipelineStageFlags2 visibleTo = 0;  // stages that already wait for the last write
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  };
  std::vector<std::vector<Barrier>> plan(steps_.size());
  std::vector<State> states(resources_.size());

  // Walk the steps twice: the first round finds in which state a frame leaves its resources.
  for (int round = 0; round < 2; ++round) {
    for (State& state : states) state.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    for (size_t s = 0; s < steps_.size(); ++s) {
      plan[s].clear();
      for (const ResourceUse& use : steps_[s].uses) {
        const UseInfo info = useInfo(use.use);
        State& state = states[use.resource];
        const bool layoutChanges = info.layout != state.layout;
        const bool waits = info.writes ? (state.writeStages | state.readStages) != 0
                                       : (state.writeStages != 0 && (info.stages & ~state.visibleTo) != 0);
        if (layoutChanges || waits) {
          // A write after reads needs their execution to end, nothing to be made visible.
          Barrier barrier{use.resource, state.writeStages, info.stages, state.writeAccess,
                          info.access,  state.layout,      info.layout};
          if (info.writes || layoutChanges) barrier.sourceStages |= state.readStages;
          if (barrier.sourceStages == 0) barrier.sourceStages = VK_PIPELINE_STAGE_2_NONE;
          plan[s].push_back(barrier);
        }
        if (info.writes) {
          state = {info.stages, 0, info.access, 0, info.layout};
        } else if (layoutChanges) {
          // The transition itself is a write that only `info.stages` wait for.
          state = {info.stages, info.stages, 0, info.stages, info.layout};
        } else {
          state.readStages |= info.stages;
          if (waits) state.visibleTo |= info.stages;
        }
      }
    }
  }
  return plan;
}

void recordBarriers(VkCommandBuffer commands, std::span<const Barrier> barriers,
                    const std::function<const Image*(ResourceId)>& imageOf) {
  std::vector<VkImageMemoryBarrier2> images;
  VkMemoryBarrier2 memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
  for (const Barrier& barrier : barriers) {
    const Image* const image = imageOf(barrier.resource);
    if (!image) {
      memory.srcStageMask |= barrier.sourceStages, memory.srcAccessMask |= barrier.sourceAccess;
      memory.dstStageMask |= barrier.targetStages, memory.dstAccessMask |= barrier.targetAccess;
      continue;
    }
    VkImageMemoryBarrier2 out{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    out.srcStageMask = barrier.sourceStages, out.srcAccessMask = barrier.sourceAccess;
    out.dstStageMask = barrier.targetStages, out.dstAccessMask = barrier.targetAccess;
    out.oldLayout = barrier.oldLayout, out.newLayout = barrier.newLayout;
    out.srcQueueFamilyIndex = out.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    out.image = image->handle();
    out.subresourceRange = {
        VkImageAspectFlags(isDepthFormat(image->desc().format) ? VK_IMAGE_ASPECT_DEPTH_BIT
                                                               : VK_IMAGE_ASPECT_COLOR_BIT),
        0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
    images.push_back(out);
  }
  VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  dependency.imageMemoryBarrierCount = uint32_t(images.size());
  dependency.pImageMemoryBarriers = images.data();
  dependency.memoryBarrierCount = memory.dstStageMask != 0;
  dependency.pMemoryBarriers = &memory;
  if (!images.empty() || memory.dstStageMask != 0) vkCmdPipelineBarrier2(commands, &dependency);
}

}  // namespace scumble::gpu
