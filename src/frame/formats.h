// The formats of a frame's images: every device has them as targets, sampled and stored to.
#pragma once

#include <vulkan/vulkan.h>

namespace scumble::frame {

inline constexpr VkFormat kBytes = VK_FORMAT_R8G8B8A8_UNORM;
inline constexpr VkFormat kHalves = VK_FORMAT_R16G16B16A16_SFLOAT;
inline constexpr VkFormat kFloats = VK_FORMAT_R32G32B32A32_SFLOAT;
inline constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

}  // namespace scumble::frame
