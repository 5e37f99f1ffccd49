#include "gpu/memory.h"

#include <algorithm>
#include <cassert>

namespace scumble::gpu {

namespace {
constexpr uint64_t kBlockSize = 64ull << 20;

uint64_t alignUp(uint64_t value, uint64_t alignment) {
  return (value + alignment - 1) & ~(alignment - 1);
}
}  // namespace

RangeAllocator::RangeAllocator(uint64_t size) : size_(size) {
  free_[0] = size;
}

uint64_t RangeAllocator::allocate(uint64_t size, uint64_t alignment) {
  for (auto it = free_.begin(); it != free_.end(); ++it) {
    const auto [start, length] = *it;
    const uint64_t offset = alignUp(start, alignment);
    if (offset > start + length || size > start + length - offset) continue;  // offset + size may overflow
    free_.erase(it);
    if (offset > start) free_[start] = offset - start;
    if (offset + size < start + length) free_[offset + size] = start + length - offset - size;
    return offset;
  }
  return kNone;
}

void RangeAllocator::release(uint64_t offset, uint64_t size) {
  auto next = free_.lower_bound(offset);
  assert(next == free_.end() || next->first >= offset + size);
  if (next != free_.end() && next->first == offset + size) {
    size += next->second;
    next = free_.erase(next);
  }
  if (next != free_.begin()) {
    auto previous = std::prev(next);
    assert(previous->first + previous->second <= offset);
    if (previous->first + previous->second == offset) {
      previous->second += size;
      return;
    }
  }
  free_[offset] = size;
}

MemoryPool::MemoryPool(VkPhysicalDevice physical, VkDevice device) : device_(device) {
  vkGetPhysicalDeviceMemoryProperties(physical, &properties_);
}

MemoryPool::~MemoryPool() {
  for (Block& block : blocks_) vkFreeMemory(device_, block.memory, nullptr);
}

uint32_t MemoryPool::chooseType(uint32_t allowed, MemoryKind kind) const {
  constexpr VkMemoryPropertyFlags kHost =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  const auto find = [&](VkMemoryPropertyFlags wanted) {
    for (uint32_t i = 0; i < properties_.memoryTypeCount; ++i)
      if ((allowed >> i & 1) && (properties_.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    return VK_MAX_MEMORY_TYPES;
  };
  uint32_t type = VK_MAX_MEMORY_TYPES;
  if (kind == MemoryKind::device) type = find(VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  if (kind == MemoryKind::readback) type = find(kHost | VK_MEMORY_PROPERTY_HOST_CACHED_BIT);
  if (type == VK_MAX_MEMORY_TYPES) type = find(kind == MemoryKind::device ? 0 : kHost);
  if (type == VK_MAX_MEMORY_TYPES) throw VulkanError{"vkAllocateMemory", VK_ERROR_FEATURE_NOT_PRESENT};
  return type;
}

MemoryPool::Block& MemoryPool::addBlock(uint64_t size, uint32_t type, bool linear) {
  // Shaders may find buffers by their address.
  const VkMemoryAllocateFlagsInfo flags{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO, nullptr,
                                        VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT, 0};
  const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, &flags, size, type};
  VkDeviceMemory memory;
  SCUMBLE_VK(vkAllocateMemory(device_, &info, nullptr, &memory));
  void* mapped = nullptr;
  constexpr VkMemoryPropertyFlags kHost =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  if ((properties_.memoryTypes[type].propertyFlags & kHost) == kHost)
    SCUMBLE_VK(vkMapMemory(device_, memory, 0, VK_WHOLE_SIZE, 0, &mapped));
  bytesReserved_ += size;
  return blocks_.emplace_back(Block{memory, size, type, linear, mapped, RangeAllocator(size)});
}

Allocation MemoryPool::allocate(const VkMemoryRequirements& needs, MemoryKind kind, bool linear) {
  const uint32_t type = chooseType(needs.memoryTypeBits, kind);
  Block* home = nullptr;
  uint64_t offset = RangeAllocator::kNone;
  if (needs.size < kBlockSize / 2) {
    for (Block& block : blocks_) {
      if (block.type != type || block.linear != linear || block.size > kBlockSize) continue;
      offset = block.ranges.allocate(needs.size, needs.alignment);
      if (offset == RangeAllocator::kNone) continue;
      home = &block;
      break;
    }
  }
  if (!home) {
    home = &addBlock(needs.size < kBlockSize / 2 ? kBlockSize : needs.size, type, linear);
    offset = home->ranges.allocate(needs.size, needs.alignment);
  }
  bytesInUse_ += needs.size;
  void* mapped = home->mapped ? static_cast<char*>(home->mapped) + offset : nullptr;
  return {home->memory, offset, needs.size, mapped, home};
}

void MemoryPool::release(const Allocation& allocation) {
  if (!allocation.block) return;
  Block* block = static_cast<Block*>(allocation.block);
  block->ranges.release(allocation.offset, allocation.size);
  bytesInUse_ -= allocation.size;
  if (!block->ranges.empty()) return;
  bytesReserved_ -= block->size;
  vkFreeMemory(device_, block->memory, nullptr);
  blocks_.remove_if([&](const Block& other) { return &other == block; });
}

}  // namespace scumble::gpu
