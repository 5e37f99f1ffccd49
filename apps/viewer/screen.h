// What a window shows: images of a swapchain, drawn one after the other. Bytes that are drawn are those that
// are shown: they are in sRGB's curve already.
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "vulkan_parts.h"

namespace scumble::viewer {

class Screen {
 public:
  static constexpr uint32_t kFrames = 2;  // under way at once

  // Takes the surface. Throws VulkanFailure, here and later.
  Screen(const VulkanDevice& device, VkSurfaceKHR surface);
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  VkFormat format() const { return format_.format; }
  VkExtent2D extent() const { return extent_; }  // of what is drawn last
  // Draws and shows one frame, over a grey; `frame`: 0 to kFrames - 1, what it had under way before has
  // ended. False where there is nothing to draw on: the window is minimised, or changes its size just now.
  bool draw(const glm::uvec2& size,
            const std::function<void(VkCommandBuffer commands, uint32_t frame)>& record);
  // Until nothing is under way.
  void settle() const;

 private:
  struct Frame {
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkSemaphore acquired = VK_NULL_HANDLE;
    VkFence done = VK_NULL_HANDLE;
  };
  struct Shown {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkSemaphore drawn = VK_NULL_HANDLE;
  };
  void begin();
  void end();
  bool remake(const glm::uvec2& size);
  void drop();
  void record(const Frame& frame, const Shown& shown, uint32_t number,
              const std::function<void(VkCommandBuffer, uint32_t)>& record) const;

  VulkanDevice device_;
  VkSurfaceKHR surface_;
  VkSurfaceFormatKHR format_{};
  VkPresentModeKHR mode_ = VK_PRESENT_MODE_FIFO_KHR;
  VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
  VkExtent2D extent_{0, 0};
  bool isOutdated_ = false;
  std::vector<Shown> shown_;
  std::array<Frame, kFrames> frames_;
  uint32_t next_ = 0;
};

}  // namespace scumble::viewer
