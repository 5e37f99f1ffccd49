// A Vulkan layer for tests: a device is lost as soon as the file is there that LOSE_DEVICE names, which it
// takes away. That device stays lost; those that are made later work, until the file is there again.
#include <unistd.h>

#include <cstdlib>
#include <set>

#include "../support/vulkan_layer.h"

namespace {

std::set<void*> lost;

template <class Handle>
bool isLost(Handle handle) {
  const std::lock_guard lock(layer::mutex);
  const char* const file = std::getenv("LOSE_DEVICE");
  if (file && unlink(file) == 0) lost.insert(layer::keyOf(handle));
  return lost.count(layer::keyOf(handle)) > 0;
}

VKAPI_ATTR VkResult VKAPI_CALL queueSubmit2(VkQueue queue, uint32_t count, const VkSubmitInfo2* infos,
                                            VkFence fence) {
  if (isLost(queue)) return VK_ERROR_DEVICE_LOST;
  return layer::next<PFN_vkQueueSubmit2>(queue, "vkQueueSubmit2")(queue, count, infos, fence);
}
VKAPI_ATTR VkResult VKAPI_CALL queuePresent(VkQueue queue, const VkPresentInfoKHR* info) {
  if (isLost(queue)) return VK_ERROR_DEVICE_LOST;
  return layer::next<PFN_vkQueuePresentKHR>(queue, "vkQueuePresentKHR")(queue, info);
}
VKAPI_ATTR VkResult VKAPI_CALL waitForFences(VkDevice device, uint32_t count, const VkFence* fences,
                                             VkBool32 all, uint64_t timeout) {
  if (isLost(device)) return VK_ERROR_DEVICE_LOST;
  return layer::next<PFN_vkWaitForFences>(device, "vkWaitForFences")(device, count, fences, all, timeout);
}

}  // namespace

void layer::deviceMade(VkDevice device) {
  lost.erase(keyOf(device));
}

std::vector<layer::Function> layer::intercepted() {
  return {{"vkQueueSubmit2", queueSubmit2},
          {"vkQueuePresentKHR", queuePresent},
          {"vkWaitForFences", waitForFences}};
}
