// Vulkan, and what happens when a call fails: an unexpected result ends the operation with the call's name.
// VulkanError never leaves the library; the renderer turns it into an Error.
#pragma once

#include <vulkan/vulkan.h>

#include <string>

namespace scumble::gpu {

struct VulkanError {
  const char* call;
  VkResult result;
  std::string message() const;
};

const char* resultName(VkResult result);

inline void check(VkResult result, const char* call) {
  if (result != VK_SUCCESS) throw VulkanError{call, result};
}

}  // namespace scumble::gpu

#define SCUMBLE_VK(call) ::scumble::gpu::check(call, #call)
