// Base of Vulkan layers for tests: the way to the next layer. A layer includes this in its one file and
// defines intercepted() and deviceMade().
#pragma once

#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <cstring>
#include <map>
#include <mutex>
#include <vector>

namespace layer {

struct Function {
  template <class Pointer>
  Function(const char* called, Pointer own)
      : name(called), pointer(reinterpret_cast<PFN_vkVoidFunction>(own)) {}
  const char* name;
  PFN_vkVoidFunction pointer;
};
// The layer's own functions, by the names of those that they take the place of.
std::vector<Function> intercepted();
// Called with `mutex` held.
void deviceMade(VkDevice device);

inline std::mutex mutex;
inline PFN_vkGetInstanceProcAddr nextInstanceProc = nullptr;
inline std::map<void*, PFN_vkGetDeviceProcAddr> nextDeviceProc;  // by what handles of one device point at
// Queues and command buffers have tables of their device: what is asked of the device serves all.
inline std::map<void*, VkDevice> deviceOf;

template <class Handle>
void* keyOf(Handle handle) {
  return *reinterpret_cast<void**>(handle);
}

// The next layer's function for a device, or for an object of one.
template <class Function, class Handle>
Function next(Handle handle, const char* name) {
  const std::lock_guard lock(mutex);
  return reinterpret_cast<Function>(nextDeviceProc[keyOf(handle)](deviceOf[keyOf(handle)], name));
}

inline VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* info,
                                                     const VkAllocationCallbacks* allocator,
                                                     VkInstance* instance) {
  auto* link = static_cast<VkLayerInstanceCreateInfo*>(const_cast<void*>(info->pNext));
  while (link->sType != VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO || link->function != VK_LAYER_LINK_INFO)
    link = static_cast<VkLayerInstanceCreateInfo*>(const_cast<void*>(link->pNext));
  nextInstanceProc = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  return reinterpret_cast<PFN_vkCreateInstance>(nextInstanceProc(VK_NULL_HANDLE, "vkCreateInstance"))(
      info, allocator, instance);
}

inline VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
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
  deviceMade(*device);
  return made;
}

inline PFN_vkVoidFunction ours(const char* name) {
  std::vector<Function> functions = intercepted();
  functions.insert(functions.end(), {{"vkCreateInstance", createInstance}, {"vkCreateDevice", createDevice}});
  for (const Function& each : functions)
    if (std::strcmp(name, each.name) == 0) return each.pointer;
  return nullptr;
}

}  // namespace layer

extern "C" {

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetDeviceProcAddr(VkDevice device, const char* name) {
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0)
    return reinterpret_cast<PFN_vkVoidFunction>(vkGetDeviceProcAddr);
  if (const PFN_vkVoidFunction function = layer::ours(name)) return function;
  const std::lock_guard lock(layer::mutex);
  return layer::nextDeviceProc[layer::keyOf(device)](device, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetInstanceProcAddr(VkInstance instance, const char* name) {
  if (std::strcmp(name, "vkGetInstanceProcAddr") == 0)
    return reinterpret_cast<PFN_vkVoidFunction>(vkGetInstanceProcAddr);
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0)
    return reinterpret_cast<PFN_vkVoidFunction>(vkGetDeviceProcAddr);
  if (const PFN_vkVoidFunction function = layer::ours(name)) return function;
  return layer::nextInstanceProc ? layer::nextInstanceProc(instance, name) : nullptr;
}

}  // extern "C"
