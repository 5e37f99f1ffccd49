// Buffers and images that own their memory, and the way data gets into them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <utility>
#include <vector>

#include "gpu/device.h"

namespace scumble::gpu {

// Where a uniform may begin in a buffer, also by a dynamic offset: no device wants larger steps than this.
constexpr uint64_t kUniformAlignment = 256;
constexpr uint64_t uniformStride(uint64_t bytes) {
  return (bytes + kUniformAlignment - 1) / kUniformAlignment * kUniformAlignment;
}

class Buffer {
 public:
  Buffer() = default;
  Buffer(Device& device, uint64_t size, VkBufferUsageFlags usage, MemoryKind kind,
         const DebugName& name = SCUMBLE_CALLER);
  ~Buffer();
  Buffer(Buffer&& other) noexcept { swap(other); }
  Buffer& operator=(Buffer&& other) noexcept {
    swap(other);
    return *this;
  }
  VkBuffer handle() const { return buffer_; }
  uint64_t size() const { return size_; }
  // Of storage buffers, for shaders that read them by `buffer_reference` from a uvec2: however large they
  // are, while a binding has a limit (maxStorageBufferRange).
  glm::uvec2 address() const;
  // Null where the CPU cannot see the memory.
  std::byte* mapped() const { return static_cast<std::byte*>(allocation_.mapped); }

 private:
  void swap(Buffer& other);
  Device* device_ = nullptr;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  Allocation allocation_;
  uint64_t size_ = 0;
};

struct ImageDesc {
  VkFormat format = VK_FORMAT_UNDEFINED;
  uint32_t width = 1, height = 1, layers = 1, mipLevels = 1;
  uint32_t samples = 1;
  bool arrayView = true;  // seen as a 2D array; textures are plain 2D
  bool operator==(const ImageDesc&) const = default;
};

class Image {
 public:
  Image() = default;
  // With memory of its own.
  Image(Device& device, const ImageDesc& desc, VkImageUsageFlags usage,
        const DebugName& name = SCUMBLE_CALLER);
  // Without memory: needs() some, and place() before anything else.
  static Image unplaced(Device& device, const ImageDesc& desc, VkImageUsageFlags usage,
                        const DebugName& name);
  VkMemoryRequirements needs() const;
  void place(VkDeviceMemory memory, uint64_t offset);
  // Somebody else's, who keeps it alive; views of it are made here.
  static Image foreign(Device& device, VkImage image, const ImageDesc& desc);
  ~Image();
  Image(Image&& other) noexcept { swap(other); }
  Image& operator=(Image&& other) noexcept {
    swap(other);
    return *this;
  }
  VkImage handle() const { return image_; }
  VkImageView view() const { return view_; }  // of all layers and levels
  // From this layer on; made when it is first asked for.
  VkImageView viewFrom(uint32_t layer) const;
  const ImageDesc& desc() const { return desc_; }

 private:
  void swap(Image& other);
  Device* device_ = nullptr;
  VkImage image_ = VK_NULL_HANDLE;
  VkImageView makeView(uint32_t firstLayer) const;
  VkImageView view_ = VK_NULL_HANDLE;
  mutable std::vector<VkImageView> viewsFrom_;  // by first layer, from 1 on
  bool isForeign_ = false;
  Allocation allocation_;  // none where the memory is not its own
  ImageDesc desc_;
};

bool isDepthFormat(VkFormat format);
VkImageAspectFlags aspectOf(VkFormat format);
uint32_t bytesPerPixel(VkFormat format);

// What was written before is there for what comes after.
void memoryBarrier(VkCommandBuffer commands, VkPipelineStageFlags2 sourceStages, VkAccessFlags2 sourceAccess,
                   VkPipelineStageFlags2 targetStages, VkAccessFlags2 targetAccess);

// Of storage buffers, between two dispatches.
void computeBarrier(VkCommandBuffer commands);
// The same, also for a dispatch whose size an earlier one has written.
void indirectBarrier(VkCommandBuffer commands);

// Gathers uploads and sends them in few submissions. Memory that the CPU sees is written directly.
class Uploader {
 public:
  explicit Uploader(Device& device) : device_(device) {}
  ~Uploader();
  // A new buffer on the device; the caller writes its contents to *target before the next flush().
  Buffer reserve(uint64_t size, VkBufferUsageFlags usage, std::byte** target,
                 const DebugName& name = SCUMBLE_CALLER);
  // A new storage buffer that holds an array; of one element's size where that is empty.
  template <class T>
  Buffer storage(std::span<const T> array, const DebugName& name = SCUMBLE_CALLER) {
    std::byte* target = nullptr;
    Buffer buffer = reserve(std::max<uint64_t>(sizeof(T), array.size_bytes()),
                            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, &target, name);
    std::copy(array.begin(), array.end(), reinterpret_cast<T*>(target));
    return buffer;
  }
  // Where the caller writes, before the next flush(), what is to be at an offset of a buffer that reserve()
  // has made; no frame under way may read that.
  std::byte* rewrite(Buffer& buffer, uint64_t offset, uint64_t size);
  // A sampled image; `levels` are its mip levels from the largest to the smallest, tightly packed, each half
  // the size of the one before (at least 1). Flushes by itself when much is staged.
  Image texture(std::span<const std::span<const std::byte>> levels, VkFormat format, uint32_t width,
                uint32_t height, const DebugName& name = SCUMBLE_CALLER);
  // Ends when all data is on the device.
  void flush();

 private:
  struct BufferCopy {
    size_t staging;
    VkBuffer target;
    uint64_t offset, size;
  };
  struct TextureCopy {
    size_t staging;  // all levels, one after the other
    VkImage target;
    ImageDesc desc;
  };
  size_t stage(uint64_t size);

  Device& device_;
  std::vector<Buffer> staging_;
  uint64_t stagedBytes_ = 0;
  std::vector<BufferCopy> buffers_;
  std::vector<TextureCopy> textures_;
};

}  // namespace scumble::gpu
