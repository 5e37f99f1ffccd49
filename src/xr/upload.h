// Pictures that stay as they are, in images of the runtime's.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scumble/vulkan.h"
#include "xr/swapchain.h"

namespace scumble::xr {

// A square of pixels in a format that frames are shown in: of bytes, or of half floats. Values are stored as
// they are given, whatever the format's curve.
class Texels {
 public:
  Texels(VkFormat format, uint32_t side)
      : format_(format),
        channelBytes_(format == VK_FORMAT_R16G16B16A16_SFLOAT ? 2 : 1),
        isBgra_(format == VK_FORMAT_B8G8R8A8_SRGB),
        side_(side),
        bytes_(4 * channelBytes_ * side * side, 0) {}
  void set(uint32_t x, uint32_t y, const glm::vec4& rgba);  // from 0 to 1
  VkFormat format() const { return format_; }
  uint32_t side() const { return side_; }
  const std::vector<uint8_t>& bytes() const { return bytes_; }

 private:
  VkFormat format_;
  size_t channelBytes_;
  bool isBgra_;
  uint32_t side_;
  std::vector<uint8_t> bytes_;
};

// A picture that the runtime draws over frames.
class StillPicture {
 public:
  // Returns when all of it is there. Throws XrFailure.
  StillPicture(const Functions& call, XrSession session, const VulkanDevice& device, const Texels& texels);
  XrSwapchainSubImage whole() const { return swapchain_.part(side_, side_); }

 private:
  uint32_t side_;
  Swapchain swapchain_;
};

}  // namespace scumble::xr
