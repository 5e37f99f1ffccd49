// Pictures into images of the runtime's.
#pragma once

#include <vector>

#include "scumble/vulkan.h"
#include "xr/functions.h"

namespace scumble::xr {

// The bytes of its pixels, as they are stored. Leaves the image, which has one layer, as runtimes want it
// back, and returns when all of it is there. Throws XrFailure.
void upload(const VulkanDevice& device, VkImage image, VkExtent2D extent, const std::vector<uint8_t>& bytes);

}  // namespace scumble::xr
