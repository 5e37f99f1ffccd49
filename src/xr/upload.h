// Pictures into images of the runtime's.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scumble/vulkan.h"
#include "xr/functions.h"

namespace scumble::xr {

// A square of pixels in a format that frames are shown in: of bytes, or of half floats. Values are stored as
// they are given, whatever the format's curve.
class Texels {
 public:
  Texels(VkFormat format, uint32_t side)
      : channelBytes_(format == VK_FORMAT_R16G16B16A16_SFLOAT ? 2 : 1),
        isBgra_(format == VK_FORMAT_B8G8R8A8_SRGB),
        side_(side),
        bytes_(4 * channelBytes_ * side * side, 0) {}
  void set(uint32_t x, uint32_t y, const glm::vec4& rgba);  // from 0 to 1
  const std::vector<uint8_t>& bytes() const { return bytes_; }

 private:
  size_t channelBytes_;
  bool isBgra_;
  uint32_t side_;
  std::vector<uint8_t> bytes_;
};

// The bytes of its pixels, as they are stored. Leaves the image, which has one layer, as runtimes want it
// back, and returns when all of it is there. Throws XrFailure.
void upload(const VulkanDevice& device, VkImage image, VkExtent2D extent, const std::vector<uint8_t>& bytes);

}  // namespace scumble::xr
