// What the window itself has of Vulkan: images and buffers with memory of their own, on the renderer's
// device. There are a dozen of them, so none shares its memory.
#pragma once

#include <vulkan/vulkan.h>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

#include "scumble/vulkan.h"

namespace scumble::viewer {

// A call that failed.
struct VulkanFailure : std::runtime_error {
  VulkanFailure(const char* call, VkResult code)
      : std::runtime_error(std::string(call) + " failed with " + std::to_string(int(code))), result(code) {}
  VkResult result;
};
inline void must(VkResult result, const char* call) {
  if (result < 0) throw VulkanFailure(call, result);
}

// A name in captures, of any kind of object.
template <class Handle>
void name(const VulkanDevice& device, VkObjectType type, Handle handle, const std::string& text) {
  nameVulkanObject(device, type, reinterpret_cast<uint64_t>(handle), "window: " + text);
}

// What is drawn into and sampled, of one layer and one level.
class DeviceImage {
 public:
  DeviceImage() = default;
  DeviceImage(const VulkanDevice& device, VkFormat format, VkExtent2D extent, VkImageUsageFlags usage,
              const std::string& what);
  ~DeviceImage();
  DeviceImage(DeviceImage&& other) noexcept { swap(other); }
  DeviceImage& operator=(DeviceImage&& other) noexcept {
    swap(other);
    return *this;
  }
  VkImage handle() const { return image_; }
  VkImageView view() const { return view_; }
  VkExtent2D extent() const { return extent_; }

 private:
  void swap(DeviceImage& other) {
    std::swap(device_, other.device_), std::swap(image_, other.image_), std::swap(memory_, other.memory_);
    std::swap(view_, other.view_), std::swap(extent_, other.extent_);
  }
  VkDevice device_ = VK_NULL_HANDLE;
  VkImage image_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  VkImageView view_ = VK_NULL_HANDLE;
  VkExtent2D extent_{0, 0};
};

// An image of 8 bit RGBA with these bytes, row 0 at the top, in VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL.
// Waits for the queue.
DeviceImage uploaded(const VulkanDevice& device, VkExtent2D extent, const uint8_t* bytes,
                     const std::string& what);

// Written by the CPU as long as it lives.
class MappedBuffer {
 public:
  MappedBuffer() = default;
  MappedBuffer(const VulkanDevice& device, VkDeviceSize size, VkBufferUsageFlags usage,
               const std::string& what);
  ~MappedBuffer();
  MappedBuffer(MappedBuffer&& other) noexcept { swap(other); }
  MappedBuffer& operator=(MappedBuffer&& other) noexcept {
    swap(other);
    return *this;
  }
  VkBuffer handle() const { return buffer_; }
  std::byte* mapped() const { return mapped_; }
  VkDeviceSize size() const { return size_; }

 private:
  void swap(MappedBuffer& other) {
    std::swap(device_, other.device_), std::swap(buffer_, other.buffer_), std::swap(memory_, other.memory_);
    std::swap(mapped_, other.mapped_), std::swap(size_, other.size_);
  }
  VkDevice device_ = VK_NULL_HANDLE;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  std::byte* mapped_ = nullptr;
  VkDeviceSize size_ = 0;
};

// All that was written before, for what is read or drawn after.
void imageBarrier(VkCommandBuffer commands, VkImage image, VkImageLayout before, VkImageLayout after);

}  // namespace scumble::viewer
