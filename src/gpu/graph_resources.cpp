#include "gpu/graph_resources.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace scumble::gpu {

Lodging lodge(std::span<const Lodger> lodgers) {
  std::vector<size_t> order(lodgers.size());
  std::iota(order.begin(), order.end(), size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return lodgers[a].bytes > lodgers[b].bytes; });
  Lodging lodging;
  lodging.offsets.assign(lodgers.size(), 0);
  std::vector<size_t> lodged;  // by offset
  for (const size_t next : order) {
    const Lodger& lodger = lodgers[next];
    uint64_t offset = 0;
    for (const size_t other : lodged) {
      if (!lodger.meets(lodgers[other])) continue;
      if (offset + lodger.bytes <= lodging.offsets[other]) break;
      const uint64_t end = lodging.offsets[other] + lodgers[other].bytes;
      if (end > offset) offset = (end + lodger.alignment - 1) & ~(lodger.alignment - 1);
    }
    lodging.offsets[next] = offset;
    lodging.bytes = std::max(lodging.bytes, offset + lodger.bytes);
    const auto byOffset = [&](size_t a, size_t b) { return lodging.offsets[a] < lodging.offsets[b]; };
    lodged.insert(std::upper_bound(lodged.begin(), lodged.end(), next, byOffset), next);
  }
  return lodging;
}

GraphResources::GraphResources(Device& device, const FrameGraph& graph, const FrameGraph::Needs& needs,
                               const ImageShape::Frame& frame)
    : device_(device), graph_(graph), needs_(needs) {
  resize(frame);
}

GraphResources::~GraphResources() {
  release();
}

void GraphResources::release() {
  images_.clear();
  for (const Allocation& allocation : memory_) device_.memory().release(allocation);
  memory_.clear();
}

void GraphResources::resize(const ImageShape::Frame& frame) {
  release();
  bytes_ = bytesUnshared_ = 0;
  const std::vector<FrameGraph::Resource>& resources = graph_.resources();
  images_.resize(resources.size());
  imported_.resize(resources.size());

  // Images of one kind of memory share it.
  std::map<uint32_t, std::vector<uint32_t>> byMemoryType;
  std::vector<Lodger> needed(resources.size());
  for (uint32_t r = 0; r < resources.size(); ++r) {
    const FrameGraph::Needs::Life& life = needs_.lives[r];
    if (!resources[r].isImage || resources[r].isImported || !life.isUsed) continue;
    if (resources[r].isKept) {
      images_[r] = Image(device_, resources[r].shape.at(frame), life.imageUsage, resources[r].name);
      bytes_ += images_[r].needs().size, bytesUnshared_ += images_[r].needs().size;
      continue;
    }
    images_[r] = Image::unplaced(device_, resources[r].shape.at(frame), life.imageUsage, resources[r].name);
    const VkMemoryRequirements needs = images_[r].needs();
    needed[r] = {needs.size, needs.alignment, life.first, life.last};
    byMemoryType[needs.memoryTypeBits].push_back(r);
    bytesUnshared_ += needs.size;
  }
  std::vector<std::vector<uint32_t>> sharing(resources.size());
  for (const auto& [type, members] : byMemoryType) {
    std::vector<Lodger> lodgers;
    VkMemoryRequirements all{0, 1, type};
    for (const uint32_t r : members) {
      lodgers.push_back(needed[r]);
      all.alignment = std::max(all.alignment, needed[r].alignment);
    }
    const Lodging lodging = lodge(lodgers);
    all.size = lodging.bytes;
    memory_.push_back(device_.memory().allocate(all, MemoryKind::device, false));
    bytes_ += all.size;
    for (size_t i = 0; i < members.size(); ++i)
      images_[members[i]].place(memory_.back().memory, memory_.back().offset + lodging.offsets[i]);
    for (size_t i = 0; i < members.size(); ++i)
      for (size_t j = 0; j < members.size(); ++j)
        if (i != j && lodging.offsets[i] < lodging.offsets[j] + lodgers[j].bytes &&
            lodging.offsets[j] < lodging.offsets[i] + lodgers[i].bytes)
          sharing[members[i]].push_back(members[j]);
  }

  // Buffers keep their size.
  if (buffers_.empty()) {
    buffers_.resize(resources.size());
    for (uint32_t r = 0; r < resources.size(); ++r)
      if (!resources[r].isImage && !resources[r].isImported && needs_.lives[r].isUsed)
        buffers_[r] = Buffer(device_, resources[r].bytes, needs_.lives[r].bufferUsage, MemoryKind::device,
                             resources[r].name);
  }
  barriers_ = graph_.planBarriers(needs_, sharing);
  beginKept();
}

void GraphResources::beginKept() {
  // As if a frame had been before.
  std::vector<Barrier> first;
  for (uint32_t r = 0; r < images_.size(); ++r) {
    if (!graph_.resources()[r].isKept || !needs_.lives[r].isUsed) continue;
    for (const Barrier& barrier : barriers_[needs_.lives[r].first])
      if (barrier.resource == r)
        first.push_back({r, VK_PIPELINE_STAGE_2_NONE, barrier.sourceStages, VK_ACCESS_2_NONE,
                         VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_UNDEFINED, barrier.oldLayout});
  }
  if (!first.empty())
    device_.runOnce([&](VkCommandBuffer commands) {
      recordBarriers(commands, first, [&](uint32_t resource) { return imageOf(resource); });
    });
}

}  // namespace scumble::gpu
