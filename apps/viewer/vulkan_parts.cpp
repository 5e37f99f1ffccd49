#include "vulkan_parts.h"

#include <cstring>
#include <mutex>

namespace scumble::viewer {

namespace {

VkDeviceMemory allocate(const VulkanDevice& device, const VkMemoryRequirements& needs,
                        VkMemoryPropertyFlags properties) {
  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(device.physical, &memory);
  for (uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
    if (!(needs.memoryTypeBits & (1u << type)) ||
        (memory.memoryTypes[type].propertyFlags & properties) != properties)
      continue;
    const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size, type};
    VkDeviceMemory made = VK_NULL_HANDLE;
    must(vkAllocateMemory(device.device, &info, nullptr, &made), "vkAllocateMemory");
    return made;
  }
  throw VulkanFailure("the choice of a memory type", VK_ERROR_FEATURE_NOT_PRESENT);
}

}  // namespace

DeviceImage::DeviceImage(const VulkanDevice& device, VkFormat format, VkExtent2D extent,
                         VkImageUsageFlags usage, const std::string& what)
    : DeviceImage() {
  device_ = device.device, extent_ = extent;
  VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = {extent.width, extent.height, 1};
  info.mipLevels = info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage = usage;
  must(vkCreateImage(device_, &info, nullptr, &image_), "vkCreateImage");
  name(device, VK_OBJECT_TYPE_IMAGE, image_, what);
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(device_, image_, &needs);
  memory_ = allocate(device, needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  must(vkBindImageMemory(device_, image_, memory_, 0), "vkBindImageMemory");
  VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  view.image = image_;
  view.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view.format = format;
  view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  must(vkCreateImageView(device_, &view, nullptr, &view_), "vkCreateImageView");
  name(device, VK_OBJECT_TYPE_IMAGE_VIEW, view_, what);
}

DeviceImage::~DeviceImage() {
  if (!device_) return;
  vkDestroyImageView(device_, view_, nullptr);
  vkDestroyImage(device_, image_, nullptr);
  vkFreeMemory(device_, memory_, nullptr);
}

MappedBuffer::MappedBuffer(const VulkanDevice& device, VkDeviceSize size, VkBufferUsageFlags usage,
                           const std::string& what)
    : MappedBuffer() {
  device_ = device.device, size_ = size;
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = size;
  info.usage = usage;
  must(vkCreateBuffer(device_, &info, nullptr, &buffer_), "vkCreateBuffer");
  name(device, VK_OBJECT_TYPE_BUFFER, buffer_, what);
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device_, buffer_, &needs);
  memory_ =
      allocate(device, needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  must(vkBindBufferMemory(device_, buffer_, memory_, 0), "vkBindBufferMemory");
  void* mapped = nullptr;
  must(vkMapMemory(device_, memory_, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
  mapped_ = static_cast<std::byte*>(mapped);
}

MappedBuffer::~MappedBuffer() {
  if (!device_) return;
  vkDestroyBuffer(device_, buffer_, nullptr);
  vkFreeMemory(device_, memory_, nullptr);
}

DeviceImage uploaded(const VulkanDevice& device, VkExtent2D extent, const uint8_t* bytes,
                     const std::string& what) {
  const VkDeviceSize size = VkDeviceSize(extent.width) * extent.height * 4;
  DeviceImage image(device, VK_FORMAT_R8G8B8A8_UNORM, extent,
                    VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT, what);
  const MappedBuffer staging(device, size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, what + ", on its way");
  std::memcpy(staging.mapped(), bytes, size);

  // Its commands go with it.
  struct Pool {
    VkDevice device;
    VkCommandPool handle = VK_NULL_HANDLE;
    ~Pool() { vkDestroyCommandPool(device, handle, nullptr); }
  } pool{device.device};
  const VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, 0,
                                         device.queueFamily};
  must(vkCreateCommandPool(device.device, &poolInfo, nullptr, &pool.handle), "vkCreateCommandPool");
  VkCommandBuffer commands;
  const VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr,
                                             pool.handle, VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
  must(vkAllocateCommandBuffers(device.device, &allocate, &commands), "vkAllocateCommandBuffers");
  const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  must(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
  imageBarrier(commands, image.handle(), VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  VkBufferImageCopy copy{};
  copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  copy.imageExtent = {extent.width, extent.height, 1};
  vkCmdCopyBufferToImage(commands, staging.handle(), image.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                         &copy);
  imageBarrier(commands, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  must(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
  const VkCommandBufferSubmitInfo submitted{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO, nullptr, commands,
                                            0};
  VkSubmitInfo2 submit{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
  submit.commandBufferInfoCount = 1, submit.pCommandBufferInfos = &submitted;
  {
    const std::lock_guard lock(*device.queueLock);
    must(vkQueueSubmit2(device.queue, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit2");
    must(vkQueueWaitIdle(device.queue), "vkQueueWaitIdle");
  }
  return image;
}

void imageBarrier(VkCommandBuffer commands, VkImage image, VkImageLayout before, VkImageLayout after) {
  VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
  barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier.oldLayout = before, barrier.newLayout = after;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  info.imageMemoryBarrierCount = 1;
  info.pImageMemoryBarriers = &barrier;
  vkCmdPipelineBarrier2(commands, &info);
}

}  // namespace scumble::viewer
