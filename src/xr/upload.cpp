#include "xr/upload.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <mutex>

#include "xr/failure.h"

namespace scumble::xr {

namespace {

void mustBe(VkResult result) {
  if (result != VK_SUCCESS) throw XrFailure("a picture for the headset", XR_ERROR_OUT_OF_MEMORY);
}

// What an upload needs while it lasts.
struct Upload {
  VkDevice device;
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkCommandPool pool = VK_NULL_HANDLE;
  VkCommandBuffer commands = VK_NULL_HANDLE;

  Upload(const VulkanDevice& on, const std::vector<uint8_t>& bytes) : device(on.device) {
    try {
      begin(on, bytes);
    } catch (...) {
      end();
      throw;
    }
  }
  ~Upload() { end(); }

  void end() const {
    vkDestroyCommandPool(device, pool, nullptr);
    vkDestroyBuffer(device, buffer, nullptr);
    vkFreeMemory(device, memory, nullptr);
  }

  void begin(const VulkanDevice& on, const std::vector<uint8_t>& bytes) {
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = bytes.size();
    info.usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
    mustBe(vkCreateBuffer(device, &info, nullptr, &buffer));
    nameVulkanObject(on, VK_OBJECT_TYPE_BUFFER, reinterpret_cast<uint64_t>(buffer), "headset: on its way");
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device, buffer, &needs);
    VkPhysicalDeviceMemoryProperties types;
    vkGetPhysicalDeviceMemoryProperties(on.physical, &types);
    constexpr VkMemoryPropertyFlags kMapped =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    // Vulkan promises one.
    uint32_t type = 0;
    while (!(needs.memoryTypeBits & (1u << type)) ||
           (types.memoryTypes[type].propertyFlags & kMapped) != kMapped)
      ++type;
    const VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size, type};
    mustBe(vkAllocateMemory(device, &allocate, nullptr, &memory));
    mustBe(vkBindBufferMemory(device, buffer, memory, 0));
    void* mapped = nullptr;
    mustBe(vkMapMemory(device, memory, 0, VK_WHOLE_SIZE, 0, &mapped));
    std::memcpy(mapped, bytes.data(), bytes.size());
    vkUnmapMemory(device, memory);
    const VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, 0,
                                           on.queueFamily};
    mustBe(vkCreateCommandPool(device, &poolInfo, nullptr, &pool));
    const VkCommandBufferAllocateInfo one{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool,
                                          VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
    mustBe(vkAllocateCommandBuffers(device, &one, &commands));
    nameVulkanObject(on, VK_OBJECT_TYPE_COMMAND_BUFFER, reinterpret_cast<uint64_t>(commands),
                     "headset: upload");
  }
};

void toLayout(VkCommandBuffer commands, VkImage image, VkImageLayout before, VkImageLayout after) {
  VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
  barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier.oldLayout = before, barrier.newLayout = after;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  info.imageMemoryBarrierCount = 1, info.pImageMemoryBarriers = &barrier;
  vkCmdPipelineBarrier2(commands, &info);
}

// Leaves the image, which has one layer, as runtimes want it back.
void upload(const VulkanDevice& device, VkImage image, VkExtent2D extent, const std::vector<uint8_t>& bytes) {
  const Upload with(device, bytes);
  const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  mustBe(vkBeginCommandBuffer(with.commands, &begin));
  toLayout(with.commands, image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  VkBufferImageCopy copy{};
  copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  copy.imageExtent = {extent.width, extent.height, 1};
  vkCmdCopyBufferToImage(with.commands, with.buffer, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
  toLayout(with.commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
           VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
  mustBe(vkEndCommandBuffer(with.commands));
  const VkCommandBufferSubmitInfo one{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO, nullptr, with.commands,
                                      0};
  VkSubmitInfo2 submit{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
  submit.commandBufferInfoCount = 1, submit.pCommandBufferInfos = &one;
  const std::lock_guard lock(*device.queueLock);
  mustBe(vkQueueSubmit2(device.queue, 1, &submit, VK_NULL_HANDLE));
  mustBe(vkQueueWaitIdle(device.queue));
}

}  // namespace

void Texels::set(uint32_t x, uint32_t y, const glm::vec4& rgba) {
  uint8_t* const texel = &bytes_[4 * channelBytes_ * (size_t(y) * side_ + x)];
  for (int channel = 0; channel < 4; ++channel) {
    const float value = rgba[isBgra_ && channel < 3 ? 2 - channel : channel];
    const uint16_t code = channelBytes_ == 2 ? glm::packHalf1x16(value)
                                             : uint16_t(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
    std::memcpy(texel + size_t(channel) * channelBytes_, &code, channelBytes_);
  }
}

StillPicture::StillPicture(const Functions& call, XrSession session, const VulkanDevice& device,
                           const Texels& texels)
    : side_(texels.side()),
      swapchain_(call, session,
                 {texels.format(),
                  XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_SAMPLED_BIT |
                      XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT,
                  side_, side_}) {
  upload(device, swapchain_.acquire(), {side_, side_}, texels.bytes());
  swapchain_.release();
}

}  // namespace scumble::xr
