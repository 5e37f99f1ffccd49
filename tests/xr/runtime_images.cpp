// Swapchains with images of the program's device, and what was drawn into them.
#include <fstream>
#include <utility>

#include "runtime.h"

namespace scumble::test {

namespace {

void mustBe(VkResult result) {
  if (result != VK_SUCCESS) runtime().mistake("Vulkan: " + std::to_string(int(result)), XR_SUCCESS);
}

uint32_t memoryType(uint32_t allowed, VkMemoryPropertyFlags wanted) {
  VkPhysicalDeviceMemoryProperties properties;
  vkGetPhysicalDeviceMemoryProperties(runtime().physical, &properties);
  for (uint32_t i = 0; i < properties.memoryTypeCount; ++i)
    if ((allowed & (1u << i)) && (properties.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
  return 0;
}

void barrier(VkCommandBuffer commands, const Swapchain& of, VkImage image, VkImageLayout before,
             VkImageLayout after) {
  VkImageMemoryBarrier2 one{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
  one.srcStageMask = one.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  one.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  one.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  one.oldLayout = before, one.newLayout = after;
  one.srcQueueFamilyIndex = one.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  one.image = image;
  const auto aspect =
      VkImageAspectFlags(of.isDepth() ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT);
  one.subresourceRange = {aspect, 0, 1, 0, of.layers};
  VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  info.imageMemoryBarrierCount = 1, info.pImageMemoryBarriers = &one;
  vkCmdPipelineBarrier2(commands, &info);
}

template <class Record>
void runOnQueue(const Record& record) {
  Runtime& r = runtime();
  const VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, 0, r.family};
  VkCommandPool pool;
  mustBe(vkCreateCommandPool(r.device, &poolInfo, nullptr, &pool));
  const VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool,
                                             VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
  VkCommandBuffer commands;
  mustBe(vkAllocateCommandBuffers(r.device, &allocate, &commands));
  const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  mustBe(vkBeginCommandBuffer(commands, &begin));
  record(commands);
  mustBe(vkEndCommandBuffer(commands));
  const VkCommandBufferSubmitInfo one{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO, nullptr, commands, 0};
  VkSubmitInfo2 submit{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
  submit.commandBufferInfoCount = 1, submit.pCommandBufferInfos = &one;
  mustBe(vkQueueSubmit2(r.queue, 1, &submit, VK_NULL_HANDLE));
  mustBe(vkQueueWaitIdle(r.queue));
  vkDestroyCommandPool(r.device, pool, nullptr);
}

XrResult XRAPI_CALL enumerateSwapchainFormats(XrSession, uint32_t capacity, uint32_t* count, int64_t* out) {
  BEGIN("xrEnumerateSwapchainFormats");
  std::vector<int64_t> formats =
      r.script.value("formats", std::vector<int64_t>{VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R8G8B8A8_SRGB});
  if (r.script.value("depth", false) || !r.synthesis().empty()) formats.push_back(VK_FORMAT_D32_SFLOAT);
  if (!r.synthesis().empty()) formats.push_back(VK_FORMAT_R16G16B16A16_SFLOAT);
  return give(formats, capacity, count, out);
}

XrResult XRAPI_CALL createSwapchain(XrSession, const XrSwapchainCreateInfo* info, XrSwapchain* swapchain) {
  BEGIN("xrCreateSwapchain");
  if (info->arraySize > 1 && !r.script.value("layers", true)) return XR_ERROR_FEATURE_UNSUPPORTED;
  NEED(info->sampleCount == 1 && info->faceCount == 1 && info->mipCount == 1, "a swapchain of another kind",
       XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED);
  auto made = std::make_unique<Swapchain>();
  made->format = VkFormat(info->format);
  made->extent = {info->width, info->height};
  made->layers = info->arraySize;
  for (int i = 0; i < 3; ++i) {
    VkImageCreateInfo image{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    image.imageType = VK_IMAGE_TYPE_2D;
    image.format = made->format;
    image.extent = {info->width, info->height, 1};
    image.mipLevels = 1, image.arrayLayers = info->arraySize;
    image.samples = VK_SAMPLE_COUNT_1_BIT;
    image.usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    if (info->usageFlags & XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT)
      image.usage |= VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    if (info->usageFlags & XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT)
      image.usage |= VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    if (info->usageFlags & XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT)
      image.usage |= VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    if (info->usageFlags & XR_SWAPCHAIN_USAGE_SAMPLED_BIT) image.usage |= VK_IMAGE_USAGE_SAMPLED_BIT;
    mustBe(vkCreateImage(r.device, &image, nullptr, &made->images.emplace_back()));
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(r.device, made->images.back(), &needs);
    const VkMemoryAllocateInfo allocate{
        VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size,
        memoryType(needs.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT)};
    mustBe(vkAllocateMemory(r.device, &allocate, nullptr, &made->memory.emplace_back()));
    mustBe(vkBindImageMemory(r.device, made->images.back(), made->memory.back(), 0));
    runOnQueue([&](VkCommandBuffer commands) {
      barrier(commands, *made, made->images.back(), VK_IMAGE_LAYOUT_UNDEFINED, made->layout());
    });
  }
  r.report["swapchains"].push_back({{"format", info->format}, {"layers", info->arraySize}});
  *swapchain = reinterpret_cast<XrSwapchain>(made.get());
  r.swapchains.insert(made.release());
  return XR_SUCCESS;
}

XrResult XRAPI_CALL destroySwapchain(XrSwapchain swapchain) {
  BEGIN("xrDestroySwapchain");
  auto* const old = reinterpret_cast<Swapchain*>(swapchain);
  NEED(r.swapchains.erase(old) == 1, "a swapchain is destroyed twice", XR_ERROR_HANDLE_INVALID);
  NEED(old->acquired < 0 || r.mayFail("xrReleaseSwapchainImage"),
       "a swapchain is destroyed with an image acquired", XR_SUCCESS);
  // Frames that draw into it must be over: the validation layers tell where they are not.
  for (const VkImage image : old->images) vkDestroyImage(r.device, image, nullptr);
  for (const VkDeviceMemory memory : old->memory) vkFreeMemory(r.device, memory, nullptr);
  delete old;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL enumerateSwapchainImages(XrSwapchain swapchain, uint32_t capacity, uint32_t* count,
                                             XrSwapchainImageBaseHeader* out) {
  BEGIN("xrEnumerateSwapchainImages");
  const auto& images = reinterpret_cast<Swapchain*>(swapchain)->images;
  *count = uint32_t(images.size());
  if (capacity == 0) return XR_SUCCESS;
  auto* const all = reinterpret_cast<XrSwapchainImageVulkan2KHR*>(out);
  for (size_t i = 0; i < images.size(); ++i) {
    NEED(all[i].type == XR_TYPE_SWAPCHAIN_IMAGE_VULKAN2_KHR, "an image's structure has no type",
         XR_ERROR_VALIDATION_FAILURE);
    all[i].image = images[i];
  }
  return XR_SUCCESS;
}

XrResult XRAPI_CALL acquireSwapchainImage(XrSwapchain swapchain, const XrSwapchainImageAcquireInfo*,
                                          uint32_t* index) {
  BEGIN("xrAcquireSwapchainImage");
  auto& from = *reinterpret_cast<Swapchain*>(swapchain);
  NEED(from.acquired < 0, "an image is acquired before the last one was released",
       XR_ERROR_CALL_ORDER_INVALID);
  from.acquired = int(from.next);
  from.next = (from.next + 1) % uint32_t(from.images.size());
  from.isWaited = false;
  *index = uint32_t(from.acquired);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL waitSwapchainImage(XrSwapchain swapchain, const XrSwapchainImageWaitInfo*) {
  BEGIN("xrWaitSwapchainImage");
  auto& from = *reinterpret_cast<Swapchain*>(swapchain);
  NEED(from.acquired >= 0 && !from.isWaited, "an image is waited for that was not acquired",
       XR_ERROR_CALL_ORDER_INVALID);
  from.isWaited = true;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL releaseSwapchainImage(XrSwapchain swapchain, const XrSwapchainImageReleaseInfo*) {
  BEGIN("xrReleaseSwapchainImage");
  auto& from = *reinterpret_cast<Swapchain*>(swapchain);
  NEED(from.acquired >= 0 && from.isWaited, "an image is released that was not waited for",
       XR_ERROR_CALL_ORDER_INVALID);
  from.released = std::exchange(from.acquired, -1);
  return XR_SUCCESS;
}

}  // namespace

// As they are stored.
std::vector<uint8_t> bytesOf(const Swapchain& from, uint32_t layer, const XrRect2Di& rect) {
  Runtime& r = runtime();
  const auto width = uint32_t(rect.extent.width), height = uint32_t(rect.extent.height);
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = VkDeviceSize(width) * height * from.pixelBytes();
  info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  VkBuffer buffer;
  mustBe(vkCreateBuffer(r.device, &info, nullptr, &buffer));
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(r.device, buffer, &needs);
  const VkMemoryAllocateInfo allocate{
      VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size,
      memoryType(needs.memoryTypeBits,
                 VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT)};
  VkDeviceMemory memory;
  mustBe(vkAllocateMemory(r.device, &allocate, nullptr, &memory));
  mustBe(vkBindBufferMemory(r.device, buffer, memory, 0));
  const VkImage image = from.images[size_t(from.released)];
  runOnQueue([&](VkCommandBuffer commands) {
    barrier(commands, from, image, from.layout(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    VkBufferImageCopy copy{};
    copy.imageSubresource = {
        VkImageAspectFlags(from.isDepth() ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT), 0, layer,
        1};
    copy.imageOffset = {rect.offset.x, rect.offset.y, 0};
    copy.imageExtent = {width, height, 1};
    vkCmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer, 1, &copy);
    barrier(commands, from, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, from.layout());
  });
  void* mapped = nullptr;
  mustBe(vkMapMemory(r.device, memory, 0, VK_WHOLE_SIZE, 0, &mapped));
  const auto* const start = static_cast<const uint8_t*>(mapped);
  std::vector<uint8_t> bytes(start, start + info.size);
  vkFreeMemory(r.device, memory, nullptr);
  vkDestroyBuffer(r.device, buffer, nullptr);
  return bytes;
}

void savePicture(const Swapchain& from, uint32_t layer, const XrRect2Di& rect, const std::string& file) {
  const bool isBgra = from.format == VK_FORMAT_B8G8R8A8_SRGB;
  if (!isBgra && from.format != VK_FORMAT_R8G8B8A8_SRGB) return;
  const std::vector<uint8_t> bytes = bytesOf(from, layer, rect);
  std::ofstream out(file, std::ios::binary);
  out << "P6\n" << rect.extent.width << " " << rect.extent.height << "\n255\n";
  for (size_t i = 0; i < bytes.size(); i += 4)
    for (const size_t channel : {isBgra ? 2 : 0, 1, isBgra ? 0 : 2}) out.put(char(bytes[i + channel]));
}

std::map<std::string, PFN_xrVoidFunction> imageCalls() {
  return {
      ENTRY(EnumerateSwapchainFormats, enumerateSwapchainFormats),
      ENTRY(CreateSwapchain, createSwapchain),
      ENTRY(DestroySwapchain, destroySwapchain),
      ENTRY(EnumerateSwapchainImages, enumerateSwapchainImages),
      ENTRY(AcquireSwapchainImage, acquireSwapchainImage),
      ENTRY(WaitSwapchainImage, waitSwapchainImage),
      ENTRY(ReleaseSwapchainImage, releaseSwapchainImage),
  };
}

}  // namespace scumble::test
