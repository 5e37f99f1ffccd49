#include "xr/swapchain.h"

#include "xr/failure.h"

namespace scumble::xr {

Swapchain::Swapchain(const Functions& call, XrSession session, const Kind& kind) : call_(call), kind_(kind) {
  XrSwapchainCreateInfo info{XR_TYPE_SWAPCHAIN_CREATE_INFO};
  info.usageFlags = kind.usage;
  info.format = kind.format;
  info.sampleCount = info.faceCount = info.mipCount = 1;
  info.width = kind.width, info.height = kind.height;
  info.arraySize = kind.layers;
  must(call_.CreateSwapchain(session, &info, &handle_), "xrCreateSwapchain");
  try {
    for (const XrSwapchainImageVulkan2KHR& image : listed<XrSwapchainImageVulkan2KHR>(
             "xrEnumerateSwapchainImages",
             [&](uint32_t capacity, uint32_t*count, XrSwapchainImageVulkan2KHR*all) {
               return call_.EnumerateSwapchainImages(handle_, capacity, count,
                                                     reinterpret_cast<XrSwapchainImageBaseHeader*>(all));
             },
             {XR_TYPE_SWAPCHAIN_IMAGE_VULKAN2_KHR}))
      images_.push_back(image.image);
  } catch (...) {
    call_.DestroySwapchain(handle_);
    throw;
  }
}

Swapchain::~Swapchain() {
  // Runtimes do not like what was acquired and never released.
  const XrSwapchainImageReleaseInfo release{XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO};
  if (isAcquired_) call_.ReleaseSwapchainImage(handle_, &release);
  call_.DestroySwapchain(handle_);
}

VkImage Swapchain::acquire() {
  uint32_t index = 0;
  const XrSwapchainImageAcquireInfo acquire{XR_TYPE_SWAPCHAIN_IMAGE_ACQUIRE_INFO};
  must(call_.AcquireSwapchainImage(handle_, &acquire, &index), "xrAcquireSwapchainImage");
  isAcquired_ = true;
  const XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, XR_INFINITE_DURATION};
  must(call_.WaitSwapchainImage(handle_, &wait), "xrWaitSwapchainImage");
  return images_.at(index);
}

void Swapchain::release() {
  if (!isAcquired_) return;
  isAcquired_ = false;
  const XrSwapchainImageReleaseInfo release{XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO};
  must(call_.ReleaseSwapchainImage(handle_, &release), "xrReleaseSwapchainImage");
}

XrSwapchainSubImage Swapchain::part(uint32_t width, uint32_t height, uint32_t layer) const {
  return {handle_, {{0, 0}, {int32_t(width), int32_t(height)}}, layer};
}

}  // namespace scumble::xr
