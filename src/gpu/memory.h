// Device memory in large blocks, because drivers allow few allocations (4096 by the specification) and each
// is slow. A block belongs to one memory type; free ranges are kept sorted and merged; large requests get a
// block of their own.
#pragma once

#include <cstdint>
#include <list>
#include <map>
#include <vector>

#include "gpu/vulkan.h"

namespace scumble::gpu {

// First-fit bookkeeping of one block's ranges; knows nothing of Vulkan.
class RangeAllocator {
 public:
  explicit RangeAllocator(uint64_t size);
  static constexpr uint64_t kNone = ~0ull;
  // Offset of a free range of `size` bytes at a multiple of `alignment` (a power of two), or kNone.
  uint64_t allocate(uint64_t size, uint64_t alignment);
  void release(uint64_t offset, uint64_t size);
  bool empty() const { return free_.size() == 1 && free_.begin()->second == size_; }

 private:
  uint64_t size_;
  std::map<uint64_t, uint64_t> free_;  // offset -> size, never adjacent
};

enum class MemoryKind {
  device,   // fastest for the GPU; mapped only where that costs nothing
  upload,   // written by the CPU, read by the GPU
  readback  // written by the GPU, read by the CPU
};

struct Allocation {
  VkDeviceMemory memory = VK_NULL_HANDLE;
  uint64_t offset = 0, size = 0;
  void* mapped = nullptr;  // null where the memory is not visible to the CPU
  void* block = nullptr;   // the pool's own
};

class MemoryPool {
 public:
  MemoryPool(VkPhysicalDevice physical, VkDevice device);
  ~MemoryPool();
  // Linear resources (buffers) and tiled ones (images) never share a block, which keeps
  // bufferImageGranularity.
  Allocation allocate(const VkMemoryRequirements& needs, MemoryKind kind, bool linear);
  void release(const Allocation& allocation);
  uint64_t bytesInUse() const { return bytesInUse_; }
  uint64_t bytesReserved() const { return bytesReserved_; }

 private:
  struct Block {
    VkDeviceMemory memory;
    uint64_t size;
    uint32_t type;
    bool linear;
    void* mapped;
    RangeAllocator ranges;
  };
  uint32_t chooseType(uint32_t allowed, MemoryKind kind) const;
  Block& addBlock(uint64_t size, uint32_t type, bool linear);

  VkDevice device_;
  VkPhysicalDeviceMemoryProperties properties_;
  std::list<Block> blocks_;
  uint64_t bytesInUse_ = 0, bytesReserved_ = 0;
};

}  // namespace scumble::gpu
