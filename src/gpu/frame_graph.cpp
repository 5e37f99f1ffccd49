#include "gpu/frame_graph.h"

#include <algorithm>
#include <cassert>

namespace scumble::gpu {

UseInfo useInfo(Use use) {
  constexpr VkPipelineStageFlags2 kDepthStages =
      VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
  constexpr VkPipelineStageFlags2 kColorStage = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
  constexpr VkPipelineStageFlags2 kVertex = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT;
  constexpr VkPipelineStageFlags2 kFragment = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
  constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  constexpr VkAccessFlags2 kColorAccess =
      VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
  constexpr VkAccessFlags2 kDepthAccess =
      VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  constexpr VkAccessFlags2 kRead = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
  constexpr VkAccessFlags2 kWrite = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
  constexpr VkImageLayout kReadOnly = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  constexpr VkImageLayout kNone = VK_IMAGE_LAYOUT_UNDEFINED;
  constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  constexpr VkAccessFlags2 kSampled = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
  switch (use) {
    case Use::sampledByVertex:
      return {kVertex, kSampled, kReadOnly, VK_IMAGE_USAGE_SAMPLED_BIT, 0, false};
    case Use::sampledByFragment:
      return {kFragment, kSampled, kReadOnly, VK_IMAGE_USAGE_SAMPLED_BIT, 0, false};
    case Use::sampledByCompute:
      return {kCompute, kSampled, kReadOnly, VK_IMAGE_USAGE_SAMPLED_BIT, 0, false};
    case Use::colorTarget:
    case Use::resolveTarget:
      return {kColorStage,
              kColorAccess,
              VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
              VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
              0,
              true};
    case Use::depthTarget:
      return {kDepthStages,
              kDepthAccess,
              VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
              VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
              0,
              true};
    case Use::depthTest:
      return {kDepthStages,
              VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT,
              VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL,
              VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
              0,
              false};
    case Use::depthResolveTarget:
      // A depth resolve happens in the colour output stage (Vulkan 1.3, section 8.3.4).
      return {kColorStage | kDepthStages,
              kColorAccess | kDepthAccess,
              VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
              VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
              0,
              true};
    case Use::storageImageWrite:
      return {kCompute, kWrite, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_USAGE_STORAGE_BIT, 0, true};
    case Use::storageImageReadWrite:
      return {kCompute, kRead | kWrite, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_USAGE_STORAGE_BIT, 0, true};
    case Use::copySource:
      return {VK_PIPELINE_STAGE_2_COPY_BIT,         VK_ACCESS_2_TRANSFER_READ_BIT,
              VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
              VK_BUFFER_USAGE_TRANSFER_SRC_BIT,     false};
    case Use::copyTarget:
      return {VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_CLEAR_BIT,
              VK_ACCESS_2_TRANSFER_WRITE_BIT,
              VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
              VK_IMAGE_USAGE_TRANSFER_DST_BIT,
              VK_BUFFER_USAGE_TRANSFER_DST_BIT,
              true};
    case Use::storageBufferRead:
      return {kCompute, kRead, kNone, 0, kStorage, false};
    case Use::storageBufferWrite:
      return {kCompute, kWrite, kNone, 0, kStorage, true};
    case Use::storageBufferReadWrite:
      return {kCompute, kRead | kWrite, kNone, 0, kStorage, true};
    case Use::storageBufferReadByVertex:
      return {kVertex, kRead, kNone, 0, kStorage, false};
    case Use::storageBufferReadByFragment:
      return {kFragment, kRead, kNone, 0, kStorage, false};
    case Use::uniformBufferByCompute:
      return {kCompute, VK_ACCESS_2_UNIFORM_READ_BIT, kNone, 0, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, false};
    case Use::vertexBuffer:
      return {VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT,
              VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT,
              kNone,
              0,
              VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
              false};
    case Use::indexBuffer:
      return {VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT,
              VK_ACCESS_2_INDEX_READ_BIT,
              kNone,
              0,
              VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
              false};
    case Use::indirectBuffer:
      return {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
              VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT,
              kNone,
              0,
              VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT,
              false};
  }
  assert(!"an unknown use");
  return {};
}

ImageDesc ImageShape::at(const Frame& frame) const {
  const auto part = [](uint32_t whole, uint32_t over) { return (whole + over - 1) / over; };
  ImageDesc desc{format};
  desc.width = width > 0 ? width : part(frame.width, overX);
  desc.height = height > 0 ? height : part(frame.height, overY);
  desc.layers = perView ? frame.views : 1;
  desc.samples = samples;
  return desc;
}

Handle FrameGraph::addImage(std::string name, const ImageShape& shape) {
  resources_.push_back({.name = std::move(name), .shape = shape});
  return {uint32_t(resources_.size() - 1), 0};
}

Handle FrameGraph::addKeptImage(std::string name, const ImageShape& shape) {
  resources_.push_back({.name = std::move(name), .isKept = true, .shape = shape});
  return {uint32_t(resources_.size() - 1), 0};
}

Handle FrameGraph::addBuffer(std::string name, uint64_t bytes) {
  resources_.push_back({.name = std::move(name), .isImage = false, .bytes = bytes});
  return {uint32_t(resources_.size() - 1), 0};
}

Handle FrameGraph::importImage(std::string name, const ImageShape& shape, std::optional<Outside> before,
                               std::optional<Outside> after) {
  resources_.push_back(
      {.name = std::move(name), .isImported = true, .shape = shape, .before = before, .after = after});
  return {uint32_t(resources_.size() - 1), 0};
}

Handle FrameGraph::importBuffer(std::string name, std::optional<Outside> before,
                                std::optional<Outside> after) {
  resources_.push_back(
      {.name = std::move(name), .isImage = false, .isImported = true, .before = before, .after = after});
  return {uint32_t(resources_.size() - 1), 0};
}

size_t FrameGraph::addStep(std::string name) {
  steps_.push_back({std::move(name), {}});
  return steps_.size() - 1;
}

Handle FrameGraph::use(Handle handle, Use use) {
  assert(!steps_.empty() && "a use before the first step");
  assert(handle.resource < resources_.size() && "an unknown resource");
  Resource& resource = resources_[handle.resource];
  std::vector<StepUse>& uses = steps_.back().uses;
  const UseInfo info = useInfo(use);
  assert((resource.isImage ? info.imageUsage != 0 : info.bufferUsage != 0) &&
         "an image used as a buffer, or the other way round");
  assert(std::none_of(uses.begin(), uses.end(),
                      [&](const StepUse& other) { return other.handle.resource == handle.resource; }) &&
         "a resource is used twice in one step");
  assert(handle.version == resource.versions && "a version that was written over");
  assert((info.writes || resource.isImported || resource.versions > 0) &&
         "a resource is read before it was written");
  if (info.writes) handle.version = ++resource.versions;
  uses.push_back({handle, use});
  return handle;
}

FrameGraph::Traffic FrameGraph::trafficOf(size_t step, const ImageShape::Frame& frame) const {
  Traffic traffic;
  for (const StepUse& use : steps_[step].uses) {
    const Resource& resource = resources_[use.handle.resource];
    if (!resource.isImage) continue;
    const ImageDesc desc = resource.shape.at(frame);
    const uint64_t bytes =
        uint64_t(desc.width) * desc.height * desc.layers * desc.samples * bytesPerPixel(desc.format);
    const bool writes = useInfo(use.use).writes;
    if (writes) traffic.written += bytes;
    if (!writes || use.handle.version > 1) traffic.read += bytes;
  }
  return traffic;
}

FrameGraph::Needs FrameGraph::needsOf(std::span<const Handle> wanted) const {
  // From the last step to the first one: whoever writes a version that is wanted is needed, and wants what it
  // reads; and the version that it goes on from.
  std::vector<std::vector<bool>> wantedVersions;
  for (const Resource& resource : resources_) {
    wantedVersions.emplace_back(resource.versions + 1, false);
    if (resource.after && resource.versions > 0) wantedVersions.back().back() = true;
  }
  for (const Handle& handle : wanted) {
    assert(handle.resource < resources_.size() && handle.version <= resources_[handle.resource].versions);
    wantedVersions[handle.resource][handle.version] = true;
  }
  Needs needs;
  needs.steps.assign(steps_.size(), false);
  needs.lives.resize(resources_.size());
  for (size_t s = steps_.size(); s-- > 0;) {
    for (const StepUse& use : steps_[s].uses)
      if (useInfo(use.use).writes && wantedVersions[use.handle.resource][use.handle.version])
        needs.steps[s] = true;
    if (!needs.steps[s]) continue;
    for (const StepUse& use : steps_[s].uses) {
      const UseInfo info = useInfo(use.use);
      wantedVersions[use.handle.resource][use.handle.version - (info.writes ? 1 : 0)] = true;
      Needs::Life& life = needs.lives[use.handle.resource];
      life.first = s;
      if (!life.isUsed) life.last = s;
      life.isUsed = true;
      life.imageUsage |= resources_[use.handle.resource].isImage ? info.imageUsage : 0;
      life.bufferUsage |= resources_[use.handle.resource].isImage ? 0 : info.bufferUsage;
    }
  }
  return needs;
}

std::vector<std::vector<Barrier>> FrameGraph::planBarriers(
    const Needs& needs, const std::vector<std::vector<uint32_t>>& sharing) const {
  // What has to be waited for before the next use of a resource.
  struct State {
    VkPipelineStageFlags2 writeStages = 0, readStages = 0;  // since the last barrier
    VkAccessFlags2 writeAccess = 0;
    VkPipelineStageFlags2 visibleTo = 0;  // stages that already wait for the last write
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    bool isFresh = true;  // not yet used in this frame
  };
  std::vector<std::vector<Barrier>> plan(steps_.size() + 1);
  std::vector<State> states(resources_.size());

  // Walk the steps twice: the first round finds in which state a frame leaves its resources.
  for (int round = 0; round < 2; ++round) {
    for (size_t r = 0; r < resources_.size(); ++r) {
      State& state = states[r];
      const Resource& resource = resources_[r];
      state.isFresh = true;
      if (!resource.isImported && !resource.isKept) state.layout = VK_IMAGE_LAYOUT_UNDEFINED;
      if (resource.before)
        state = {resource.before->stages, 0, resource.before->access, 0, resource.before->layout};
    }
    for (size_t s = 0; s < steps_.size(); ++s) {
      plan[s].clear();
      if (!needs.steps[s]) continue;
      for (const StepUse& use : steps_[s].uses) {
        const UseInfo info = useInfo(use.use);
        const uint32_t r = use.handle.resource;
        const VkImageLayout layout = resources_[r].isImage ? info.layout : VK_IMAGE_LAYOUT_UNDEFINED;
        State& state = states[r];

        // Whoever was in its memory before it has to be out of it.
        bool takesOver = false;
        if (state.isFresh && r < sharing.size())
          for (const uint32_t other : sharing[r]) {
            const State& earlier = states[other];
            takesOver |= (earlier.writeStages | earlier.readStages) != 0;
            state.writeStages |= earlier.writeStages;
            state.writeAccess |= earlier.writeAccess;
            state.readStages |= earlier.readStages;
          }
        state.isFresh = false;

        const bool layoutChanges = layout != state.layout;
        const bool waits = info.writes ? (state.writeStages | state.readStages) != 0
                                       : (state.writeStages != 0 && (info.stages & ~state.visibleTo) != 0);
        if (layoutChanges || waits) {
          // A write after reads needs their execution to end, nothing to be made visible.
          Barrier barrier{r,           state.writeStages, info.stages, state.writeAccess,
                          info.access, state.layout,      layout,      takesOver};
          if (info.writes || layoutChanges) barrier.sourceStages |= state.readStages;
          plan[s].push_back(barrier);
        }
        if (info.writes) {
          state = {info.stages, 0, info.access, 0, layout, false};
        } else if (layoutChanges) {
          // The transition itself is a write that only `info.stages` wait for.
          state = {info.stages, info.stages, 0, info.stages, layout, false};
        } else {
          state.readStages |= info.stages;
          if (waits) state.visibleTo |= info.stages;
        }
      }
    }
  }

  // What is handed on goes into the state that is asked for.
  for (uint32_t r = 0; r < resources_.size(); ++r) {
    const Resource& resource = resources_[r];
    if (!resource.after || !needs.lives[r].isUsed) continue;
    const State& state = states[r];
    plan.back().push_back({r, state.writeStages | state.readStages, resource.after->stages, state.writeAccess,
                           resource.after->access, state.layout,
                           resource.isImage ? resource.after->layout : VK_IMAGE_LAYOUT_UNDEFINED});
  }
  return plan;
}

namespace {

const char* nameOf(VkFormat format) {
  switch (format) {
    case VK_FORMAT_R8G8B8A8_UNORM:
      return "rgba8";
    case VK_FORMAT_R8G8B8A8_SRGB:
      return "rgba8 sRGB";
    case VK_FORMAT_R16G16B16A16_SFLOAT:
      return "rgba16f";
    case VK_FORMAT_R32G32B32A32_SFLOAT:
      return "rgba32f";
    case VK_FORMAT_R32G32_SFLOAT:
      return "rg32f";
    case VK_FORMAT_R32_SFLOAT:
      return "r32f";
    case VK_FORMAT_R32_UINT:
      return "r32u";
    case VK_FORMAT_R32G32B32A32_UINT:
      return "rgba32u";
    case VK_FORMAT_D32_SFLOAT:
      return "depth32f";
    default:
      return "another format";
  }
}

}  // namespace

std::string FrameGraph::toDot(const Needs& needs, const ImageShape::Frame& frame) const {
  // Names.
  const auto quoted = [](const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
      if (c == '"' || c == '\\') out += '\\';
      if (c == '\n')
        out += "\\n";
      else
        out += c;
    }
    return out + "\"";
  };
  const auto nodeOf = [](Handle handle) {
    return "r" + std::to_string(handle.resource) + "v" + std::to_string(handle.version);
  };
  constexpr const char* kGrey = ", color=gray70, fontcolor=gray60";
  // Versions of resources, each once.
  std::string steps, versions, edges;
  std::vector<std::vector<bool>> drawn;
  for (const Resource& resource : resources_) drawn.emplace_back(resource.versions + 1, false);
  const auto drawVersion = [&](Handle handle, bool isNeeded) {
    if (drawn[handle.resource][handle.version]) return;
    drawn[handle.resource][handle.version] = true;
    const Resource& resource = resources_[handle.resource];
    std::string label = resource.name;
    if (resource.versions > 1) label += ", version " + std::to_string(handle.version);
    if (resource.isImage) {
      const ImageDesc desc = resource.shape.at(frame);
      label += "\n" + std::to_string(desc.width) + " x " + std::to_string(desc.height);
      if (desc.layers > 1) label += " x " + std::to_string(desc.layers);
      label += std::string(" ") + nameOf(desc.format);
      if (desc.samples > 1) label += ", " + std::to_string(desc.samples) + " samples";
    } else if (resource.bytes > 0) {
      label += "\n" + std::to_string(resource.bytes) + " bytes";
    }
    versions += "  " + nodeOf(handle) + " [label=" + quoted(label) +
                ", shape=" + (resource.isImage ? "ellipse" : "cylinder") +
                (resource.isImported || resource.isKept ? ", style=bold" : "") + (isNeeded ? "" : kGrey) +
                "];\n";
  };
  // Steps, with what they read and write.
  for (size_t s = 0; s < steps_.size(); ++s) {
    const std::string node = "s" + std::to_string(s);
    const char* const color = needs.steps[s] ? "" : kGrey;
    steps += "  " + node + " [label=" + quoted(steps_[s].name) + color + "];\n";
    for (const StepUse& use : steps_[s].uses) {
      drawVersion(use.handle, needs.steps[s]);
      const std::string style = needs.steps[s] ? "" : " [color=gray70]";
      if (!useInfo(use.use).writes) {
        edges += "  " + nodeOf(use.handle) + " -> " + node + style + ";\n";
        continue;
      }
      edges += "  " + node + " -> " + nodeOf(use.handle) + style + ";\n";
      const Handle before{use.handle.resource, use.handle.version - 1};
      if (before.version == 0) continue;
      edges += "  " + nodeOf(before) + " -> " + node + style + ";\n";
    }
  }
  return "digraph frame {\n  rankdir=TB;\n  node [fontname=\"sans-serif\", fontsize=11];\n"
         "  node [shape=box, style=filled, fillcolor=\"#f2e6c9\"];\n" +
         steps + "  node [style=\"\", fillcolor=none];\n" + versions + edges + "}\n";
}

void recordBarriers(VkCommandBuffer commands, std::span<const Barrier> barriers,
                    const std::function<const Image*(uint32_t resource)>& imageOf) {
  std::vector<VkImageMemoryBarrier2> images;
  VkMemoryBarrier2 memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
  for (const Barrier& barrier : barriers) {
    const Image* const image = imageOf(barrier.resource);
    if (!image || barrier.takesOver) {
      memory.srcStageMask |= barrier.sourceStages, memory.srcAccessMask |= barrier.sourceAccess;
      memory.dstStageMask |= barrier.targetStages, memory.dstAccessMask |= barrier.targetAccess;
    }
    if (!image) continue;
    VkImageMemoryBarrier2 out{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    out.srcStageMask = barrier.sourceStages, out.srcAccessMask = barrier.sourceAccess;
    out.dstStageMask = barrier.targetStages, out.dstAccessMask = barrier.targetAccess;
    out.oldLayout = barrier.oldLayout, out.newLayout = barrier.newLayout;
    out.srcQueueFamilyIndex = out.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    out.image = image->handle();
    out.subresourceRange = {aspectOf(image->desc().format), 0, VK_REMAINING_MIP_LEVELS, 0,
                            VK_REMAINING_ARRAY_LAYERS};
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
