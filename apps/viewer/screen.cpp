#include "screen.h"

#include <algorithm>
#include <mutex>

namespace scumble::viewer {

namespace {

constexpr VkClearColorValue kGrey{{0.18f, 0.18f, 0.18f, 1}};

VkSemaphore makeSemaphore(VkDevice device) {
  const VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, nullptr, 0};
  VkSemaphore made;
  must(vkCreateSemaphore(device, &info, nullptr, &made), "vkCreateSemaphore");
  return made;
}

// Eight bits that are shown as they are.
VkSurfaceFormatKHR chosenFormat(const VulkanDevice& device, VkSurfaceKHR surface) {
  uint32_t count = 0;
  must(vkGetPhysicalDeviceSurfaceFormatsKHR(device.physical, surface, &count, nullptr),
       "vkGetPhysicalDeviceSurfaceFormatsKHR");
  std::vector<VkSurfaceFormatKHR> formats(count);
  must(vkGetPhysicalDeviceSurfaceFormatsKHR(device.physical, surface, &count, formats.data()),
       "vkGetPhysicalDeviceSurfaceFormatsKHR");
  for (const VkSurfaceFormatKHR& format : formats)
    if ((format.format == VK_FORMAT_B8G8R8A8_UNORM || format.format == VK_FORMAT_R8G8B8A8_UNORM) &&
        format.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR)
      return format;
  throw VulkanFailure("the choice of a format that the window shows", VK_ERROR_FORMAT_NOT_SUPPORTED);
}

// One that never waits while the queue is held, where there is one: the window keeps its own pace.
VkPresentModeKHR chosenMode(const VulkanDevice& device, VkSurfaceKHR surface) {
  uint32_t count = 0;
  must(vkGetPhysicalDeviceSurfacePresentModesKHR(device.physical, surface, &count, nullptr),
       "vkGetPhysicalDeviceSurfacePresentModesKHR");
  std::vector<VkPresentModeKHR> modes(count);
  must(vkGetPhysicalDeviceSurfacePresentModesKHR(device.physical, surface, &count, modes.data()),
       "vkGetPhysicalDeviceSurfacePresentModesKHR");
  const bool isThere = std::find(modes.begin(), modes.end(), VK_PRESENT_MODE_MAILBOX_KHR) != modes.end();
  return isThere ? VK_PRESENT_MODE_MAILBOX_KHR : VK_PRESENT_MODE_FIFO_KHR;
}

}  // namespace

Screen::Screen(const VulkanDevice& device, VkSurfaceKHR surface) : device_(device), surface_(surface) {
  try {
    begin();
  } catch (...) {
    end();
    throw;
  }
}

void Screen::begin() {
  const VulkanDevice& device = device_;
  const VkSurfaceKHR surface = surface_;
  VkBool32 isShown = VK_FALSE;
  must(vkGetPhysicalDeviceSurfaceSupportKHR(device.physical, device.queueFamily, surface, &isShown),
       "vkGetPhysicalDeviceSurfaceSupportKHR");
  if (!isShown) throw VulkanFailure("showing what the device draws", VK_ERROR_FEATURE_NOT_PRESENT);
  format_ = chosenFormat(device, surface);
  mode_ = chosenMode(device, surface);
  for (Frame& frame : frames_) {
    const VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr,
                                       VK_COMMAND_POOL_CREATE_TRANSIENT_BIT, device.queueFamily};
    must(vkCreateCommandPool(device.device, &pool, nullptr, &frame.pool), "vkCreateCommandPool");
    const VkCommandBufferAllocateInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr,
                                               frame.pool, VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
    must(vkAllocateCommandBuffers(device.device, &commands, &frame.commands), "vkAllocateCommandBuffers");
    name(device, VK_OBJECT_TYPE_COMMAND_BUFFER, frame.commands, "frame");
    const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, nullptr, VK_FENCE_CREATE_SIGNALED_BIT};
    must(vkCreateFence(device.device, &fence, nullptr, &frame.done), "vkCreateFence");
    frame.acquired = makeSemaphore(device.device);
  }
}

Screen::~Screen() {
  settle();
  end();
}

void Screen::end() {
  drop();
  if (swapchain_) vkDestroySwapchainKHR(device_.device, swapchain_, nullptr);
  for (const Frame& frame : frames_) {
    vkDestroyCommandPool(device_.device, frame.pool, nullptr);
    vkDestroyFence(device_.device, frame.done, nullptr);
    vkDestroySemaphore(device_.device, frame.acquired, nullptr);
  }
  vkDestroySurfaceKHR(device_.instance, surface_, nullptr);
}

void Screen::settle() const {
  const std::lock_guard lock(*device_.queueLock);
  vkQueueWaitIdle(device_.queue);
}

void Screen::drop() {
  for (const Shown& shown : shown_) {
    vkDestroyImageView(device_.device, shown.view, nullptr);
    vkDestroySemaphore(device_.device, shown.drawn, nullptr);
  }
  shown_.clear();
}

bool Screen::remake(const glm::uvec2& size) {
  VkSurfaceCapabilitiesKHR can;
  must(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_.physical, surface_, &can),
       "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
  VkExtent2D extent = can.currentExtent;
  if (extent.width == ~0u)
    extent = {std::clamp(size.x, can.minImageExtent.width, can.maxImageExtent.width),
              std::clamp(size.y, can.minImageExtent.height, can.maxImageExtent.height)};
  if (extent.width == 0 || extent.height == 0) return false;
  settle();
  drop();
  VkSwapchainCreateInfoKHR info{VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
  info.surface = surface_;
  info.minImageCount = std::max(can.minImageCount, kFrames + 1);
  if (can.maxImageCount > 0) info.minImageCount = std::min(info.minImageCount, can.maxImageCount);
  info.imageFormat = format_.format;
  info.imageColorSpace = format_.colorSpace;
  info.imageExtent = extent;
  info.imageArrayLayers = 1;
  info.imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  info.preTransform = can.currentTransform;
  info.compositeAlpha = can.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                            ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                            : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
  info.presentMode = mode_;
  info.clipped = VK_TRUE;
  info.oldSwapchain = swapchain_;
  VkSwapchainKHR made = VK_NULL_HANDLE;
  must(vkCreateSwapchainKHR(device_.device, &info, nullptr, &made), "vkCreateSwapchainKHR");
  if (swapchain_) vkDestroySwapchainKHR(device_.device, swapchain_, nullptr);
  swapchain_ = made, extent_ = extent, isOutdated_ = false;

  uint32_t count = 0;
  must(vkGetSwapchainImagesKHR(device_.device, swapchain_, &count, nullptr), "vkGetSwapchainImagesKHR");
  std::vector<VkImage> images(count);
  must(vkGetSwapchainImagesKHR(device_.device, swapchain_, &count, images.data()), "vkGetSwapchainImagesKHR");
  for (const VkImage image : images) {
    VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view.image = image;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = format_.format;
    view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    Shown shown{.image = image};
    must(vkCreateImageView(device_.device, &view, nullptr, &shown.view), "vkCreateImageView");
    const std::string number = "screen " + std::to_string(shown_.size());
    name(device_, VK_OBJECT_TYPE_IMAGE, image, number);
    name(device_, VK_OBJECT_TYPE_IMAGE_VIEW, shown.view, number);
    shown.drawn = makeSemaphore(device_.device);
    shown_.push_back(shown);
  }
  return true;
}

bool Screen::draw(const glm::uvec2& size,
                  const std::function<void(VkCommandBuffer commands, uint32_t frame)>& record) {
  if (size.x == 0 || size.y == 0) return false;
  // Not every driver says so when a window has another size.
  const bool fits = swapchain_ && !isOutdated_ && extent_.width == size.x && extent_.height == size.y;
  if (!fits && !remake(size)) return false;
  const Frame& frame = frames_[next_];
  must(vkWaitForFences(device_.device, 1, &frame.done, VK_TRUE, UINT64_MAX), "vkWaitForFences");
  uint32_t index = 0;
  const VkResult acquired =
      vkAcquireNextImageKHR(device_.device, swapchain_, UINT64_MAX, frame.acquired, VK_NULL_HANDLE, &index);
  if (acquired == VK_ERROR_OUT_OF_DATE_KHR) {
    isOutdated_ = true;
    return false;
  }
  must(acquired, "vkAcquireNextImageKHR");
  isOutdated_ = acquired == VK_SUBOPTIMAL_KHR;
  must(vkResetFences(device_.device, 1, &frame.done), "vkResetFences");
  must(vkResetCommandPool(device_.device, frame.pool, 0), "vkResetCommandPool");
  this->record(frame, shown_[index], next_, record);

  const VkCommandBufferSubmitInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO, nullptr,
                                           frame.commands, 0};
  VkSemaphoreSubmitInfo wait{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO}, signal = wait;
  wait.semaphore = frame.acquired, wait.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  signal.semaphore = shown_[index].drawn, signal.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  VkSubmitInfo2 submit{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
  submit.waitSemaphoreInfoCount = submit.commandBufferInfoCount = submit.signalSemaphoreInfoCount = 1;
  submit.pWaitSemaphoreInfos = &wait, submit.pCommandBufferInfos = &commands,
  submit.pSignalSemaphoreInfos = &signal;
  VkPresentInfoKHR present{VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
  present.waitSemaphoreCount = present.swapchainCount = 1;
  present.pWaitSemaphores = &shown_[index].drawn;
  present.pSwapchains = &swapchain_;
  present.pImageIndices = &index;
  const std::lock_guard lock(*device_.queueLock);
  must(vkQueueSubmit2(device_.queue, 1, &submit, frame.done), "vkQueueSubmit2");
  const VkResult presented = vkQueuePresentKHR(device_.queue, &present);
  if (presented == VK_ERROR_OUT_OF_DATE_KHR || presented == VK_SUBOPTIMAL_KHR)
    isOutdated_ = true;
  else
    must(presented, "vkQueuePresentKHR");
  next_ = (next_ + 1) % kFrames;
  return true;
}

void Screen::record(const Frame& frame, const Shown& shown, uint32_t number,
                    const std::function<void(VkCommandBuffer, uint32_t)>& record) const {
  const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr,
                                       VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT, nullptr};
  must(vkBeginCommandBuffer(frame.commands, &begin), "vkBeginCommandBuffer");
  imageBarrier(frame.commands, shown.image, VK_IMAGE_LAYOUT_UNDEFINED,
               VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
  VkRenderingAttachmentInfo target{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  target.imageView = shown.view;
  target.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  target.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR, target.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  target.clearValue.color = kGrey;
  VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
  info.renderArea = {{0, 0}, extent_};
  info.layerCount = info.colorAttachmentCount = 1;
  info.pColorAttachments = &target;
  vkCmdBeginRendering(frame.commands, &info);
  record(frame.commands, number);
  vkCmdEndRendering(frame.commands);
  imageBarrier(frame.commands, shown.image, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
               VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
  must(vkEndCommandBuffer(frame.commands), "vkEndCommandBuffer");
}

}  // namespace scumble::viewer
