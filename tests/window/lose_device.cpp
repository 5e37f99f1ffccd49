// A Vulkan layer for tests: a device is lost as soon as the file is there that LOSE_DEVICE names, which it
// takes away. That device stays lost; those that are made later work, until the file is there again.
#include <unistd.h>
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <set>
#include <string>

namespace {

std::mutex mutex;
PFN_vkGetInstanceProcAddr nextInstanceProc = nullptr;
std::map<void*, PFN_vkGetDeviceProcAddr> nextDeviceProc;  // by what handles of one device point at
std::set<void*> lost;

template <class Handle>
void* keyOf(Handle handle) {
  return *reinterpret_cast<void**>(handle);
}

template <class Function, class Handle>
Function next(Handle handle, const char* name) {
  const std::lock_guard lock(mutex);
  return reinterpret_cast<Function>(nextDeviceProc[keyOf(handle)](reinterpret_cast<VkDevice>(handle), name));
}

template <class Handle>
bool isLost(Handle handle) {
  const std::lock_guard lock(mutex);
  const char* const file = std::getenv("LOSE_DEVICE");
  if (file && unlink(file) == 0) lost.insert(keyOf(handle));
  return lost.count(keyOf(handle)) > 0;
}

// Queues have tables of their device: what is asked of the device serves both.
std::map<void*, VkDevice> deviceOf;

template <class Function>
Function nextOfQueue(VkQueue queue, const char* name) {
  const std::lock_guard lock(mutex);
  return reinterpret_cast<Function>(nextDeviceProc[keyOf(queue)](deviceOf[keyOf(queue)], name));
}

VKAPI_ATTR VkResult VKAPI_CALL queueSubmit2(VkQueue queue, uint32_t count, const VkSubmitInfo2* infos,
                                            VkFence fence) {
  if (isLost(queue)) return VK_ERROR_DEVICE_LOST;
  return nextOfQueue<PFN_vkQueueSubmit2>(queue, "vkQueueSubmit2")(queue, count, infos, fence);
}
VKAPI_ATTR VkResult VKAPI_CALL queuePresent(VkQueue queue, const VkPresentInfoKHR* info) {
  if (isLost(queue)) return VK_ERROR_DEVICE_LOST;
  return nextOfQueue<PFN_vkQueuePresentKHR>(queue, "vkQueuePresentKHR")(queue, info);
}
VKAPI_ATTR VkResult VKAPI_CALL waitForFences(VkDevice device, uint32_t count, const VkFence* fences,
                                             VkBool32 all, uint64_t timeout) {
  if (isLost(device)) return VK_ERROR_DEVICE_LOST;
  return next<PFN_vkWaitForFences>(device, "vkWaitForFences")(device, count, fences, all, timeout);
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* info,
                                              const VkAllocationCallbacks* allocator, VkInstance* instance) {
  auto* link = static_cast<VkLayerInstanceCreateInfo*>(const_cast<void*>(info->pNext));
  while (link->sType != VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO || link->function != VK_LAYER_LINK_INFO)
    link = static_cast<VkLayerInstanceCreateInfo*>(const_cast<void*>(link->pNext));
  nextInstanceProc = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  return reinterpret_cast<PFN_vkCreateInstance>(nextInstanceProc(VK_NULL_HANDLE, "vkCreateInstance"))(
      info, allocator, instance);
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkDevice* device) {
  auto* link = static_cast<VkLayerDeviceCreateInfo*>(const_cast<void*>(info->pNext));
  while (link->sType != VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO || link->function != VK_LAYER_LINK_INFO)
    link = static_cast<VkLayerDeviceCreateInfo*>(const_cast<void*>(link->pNext));
  const PFN_vkGetInstanceProcAddr instanceProc = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  const PFN_vkGetDeviceProcAddr deviceProc = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const auto create = reinterpret_cast<PFN_vkCreateDevice>(instanceProc(VK_NULL_HANDLE, "vkCreateDevice"));
  const VkResult made = create(physical, info, allocator, device);
  if (made != VK_SUCCESS) return made;
  const std::lock_guard lock(mutex);
  nextDeviceProc[keyOf(*device)] = deviceProc;
  deviceOf[keyOf(*device)] = *device;
  lost.erase(keyOf(*device));
  return made;
}

PFN_vkVoidFunction ours(const char* name) {
  const std::pair<const char*, PFN_vkVoidFunction> functions[] = {
      {"vkCreateInstance", reinterpret_cast<PFN_vkVoidFunction>(createInstance)},
      {"vkCreateDevice", reinterpret_cast<PFN_vkVoidFunction>(createDevice)},
      {"vkQueueSubmit2", reinterpret_cast<PFN_vkVoidFunction>(queueSubmit2)},
      {"vkQueuePresentKHR", reinterpret_cast<PFN_vkVoidFunction>(queuePresent)},
      {"vkWaitForFences", reinterpret_cast<PFN_vkVoidFunction>(waitForFences)}};
  for (const auto& [known, function] : functions)
    if (std::strcmp(name, known) == 0) return function;
  return nullptr;
}

}  // namespace

extern "C" {

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetDeviceProcAddr(VkDevice device, const char* name) {
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0)
    return reinterpret_cast<PFN_vkVoidFunction>(vkGetDeviceProcAddr);
  if (const PFN_vkVoidFunction function = ours(name)) return function;
  const std::lock_guard lock(mutex);
  return nextDeviceProc[keyOf(device)](device, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetInstanceProcAddr(VkInstance instance, const char* name) {
  if (std::strcmp(name, "vkGetInstanceProcAddr") == 0)
    return reinterpret_cast<PFN_vkVoidFunction>(vkGetInstanceProcAddr);
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0)
    return reinterpret_cast<PFN_vkVoidFunction>(vkGetDeviceProcAddr);
  if (const PFN_vkVoidFunction function = ours(name)) return function;
  return nextInstanceProc ? nextInstanceProc(instance, name) : nullptr;
}

}  // extern "C"
