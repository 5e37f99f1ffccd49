// Images of the runtime's, of which one at a time is drawn into.
#pragma once

#include <optional>
#include <vector>

#include "scumble/vulkan.h"
#include "xr/functions.h"

namespace scumble::xr {

class Swapchain {
 public:
  struct Kind {
    VkFormat format = VK_FORMAT_UNDEFINED;
    XrSwapchainUsageFlags usage = 0;
    uint32_t width = 0, height = 0, layers = 1;
  };
  // Throws XrFailure, as all calls here do.
  Swapchain(const Functions& call, XrSession session, const Kind& kind);
  ~Swapchain();  // gives back what is acquired
  Swapchain(const Swapchain&) = delete;
  Swapchain& operator=(const Swapchain&) = delete;

  const Kind& kind() const { return kind_; }
  // The next image, which may be written to until release().
  VkImage acquire();
  // Gives it back; nothing where none is acquired.
  void release();
  // A rectangle from the upper left corner of what was drawn last, for layers of a frame.
  XrSwapchainSubImage part(uint32_t width, uint32_t height, uint32_t layer = 0) const;

 private:
  const Functions& call_;
  Kind kind_;
  XrSwapchain handle_ = XR_NULL_HANDLE;
  std::vector<VkImage> images_;
  bool isAcquired_ = false;
};

}  // namespace scumble::xr
