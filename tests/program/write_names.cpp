// A Vulkan layer for tests: what is made, and what it is called (VK_EXT_debug_utils), in order, as lines of
// the file that WRITE_NAMES names: "made KIND HANDLE", "named KIND HANDLE NAME", "begin NAME", "end", "queue
// NAME", "queue-end" and "submit". KIND is the number of a VkObjectType.
#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include "../support/vulkan_layer.h"

namespace {

std::FILE* file() {
  static std::FILE* const opened = std::fopen(std::getenv("WRITE_NAMES"), "w");
  return opened;
}

template <class... Values>
void write(const char* format, Values... values) {
  const std::lock_guard lock(layer::mutex);
  std::fprintf(file(), format, values...);
  std::fflush(file());
}

template <class Handle>
void made(VkObjectType kind, Handle handle) {
  write("made %d %" PRIx64 "\n", int(kind), uint64_t(handle));
}

VKAPI_ATTR VkResult VKAPI_CALL createBuffer(VkDevice device, const VkBufferCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkBuffer* buffer) {
  const VkResult result =
      layer::next<PFN_vkCreateBuffer>(device, "vkCreateBuffer")(device, info, allocator, buffer);
  if (result == VK_SUCCESS) made(VK_OBJECT_TYPE_BUFFER, *buffer);
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createImage(VkDevice device, const VkImageCreateInfo* info,
                                           const VkAllocationCallbacks* allocator, VkImage* image) {
  const VkResult result =
      layer::next<PFN_vkCreateImage>(device, "vkCreateImage")(device, info, allocator, image);
  if (result == VK_SUCCESS) made(VK_OBJECT_TYPE_IMAGE, *image);
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createGraphicsPipelines(VkDevice device, VkPipelineCache cache, uint32_t count,
                                                       const VkGraphicsPipelineCreateInfo* infos,
                                                       const VkAllocationCallbacks* allocator,
                                                       VkPipeline* pipelines) {
  const VkResult result = layer::next<PFN_vkCreateGraphicsPipelines>(device, "vkCreateGraphicsPipelines")(
      device, cache, count, infos, allocator, pipelines);
  for (uint32_t i = 0; i < count && result == VK_SUCCESS; ++i) made(VK_OBJECT_TYPE_PIPELINE, pipelines[i]);
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createComputePipelines(VkDevice device, VkPipelineCache cache, uint32_t count,
                                                      const VkComputePipelineCreateInfo* infos,
                                                      const VkAllocationCallbacks* allocator,
                                                      VkPipeline* pipelines) {
  const VkResult result = layer::next<PFN_vkCreateComputePipelines>(device, "vkCreateComputePipelines")(
      device, cache, count, infos, allocator, pipelines);
  for (uint32_t i = 0; i < count && result == VK_SUCCESS; ++i) made(VK_OBJECT_TYPE_PIPELINE, pipelines[i]);
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL setName(VkDevice, const VkDebugUtilsObjectNameInfoEXT* info) {
  write("named %d %" PRIx64 " %s\n", int(info->objectType), info->objectHandle, info->pObjectName);
  return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL beginLabel(VkCommandBuffer, const VkDebugUtilsLabelEXT* label) {
  write("begin %s\n", label->pLabelName);
}
VKAPI_ATTR void VKAPI_CALL endLabel(VkCommandBuffer) {
  write("end\n");
}
VKAPI_ATTR void VKAPI_CALL beginQueueLabel(VkQueue, const VkDebugUtilsLabelEXT* label) {
  write("queue %s\n", label->pLabelName);
}
VKAPI_ATTR void VKAPI_CALL endQueueLabel(VkQueue) {
  write("queue-end\n");
}

VKAPI_ATTR VkResult VKAPI_CALL queueSubmit2(VkQueue queue, uint32_t count, const VkSubmitInfo2* infos,
                                            VkFence fence) {
  write("submit\n");
  return layer::next<PFN_vkQueueSubmit2>(queue, "vkQueueSubmit2")(queue, count, infos, fence);
}

}  // namespace

void layer::deviceMade(VkDevice) {}

PFN_vkVoidFunction layer::intercepted(const char* name) {
  const std::pair<const char*, PFN_vkVoidFunction> functions[] = {
      {"vkCreateBuffer", reinterpret_cast<PFN_vkVoidFunction>(createBuffer)},
      {"vkCreateImage", reinterpret_cast<PFN_vkVoidFunction>(createImage)},
      {"vkCreateGraphicsPipelines", reinterpret_cast<PFN_vkVoidFunction>(createGraphicsPipelines)},
      {"vkCreateComputePipelines", reinterpret_cast<PFN_vkVoidFunction>(createComputePipelines)},
      {"vkSetDebugUtilsObjectNameEXT", reinterpret_cast<PFN_vkVoidFunction>(setName)},
      {"vkCmdBeginDebugUtilsLabelEXT", reinterpret_cast<PFN_vkVoidFunction>(beginLabel)},
      {"vkCmdEndDebugUtilsLabelEXT", reinterpret_cast<PFN_vkVoidFunction>(endLabel)},
      {"vkQueueBeginDebugUtilsLabelEXT", reinterpret_cast<PFN_vkVoidFunction>(beginQueueLabel)},
      {"vkQueueEndDebugUtilsLabelEXT", reinterpret_cast<PFN_vkVoidFunction>(endQueueLabel)},
      {"vkQueueSubmit2", reinterpret_cast<PFN_vkVoidFunction>(queueSubmit2)}};
  for (const auto& [known, function] : functions)
    if (std::strcmp(name, known) == 0) return function;
  return nullptr;
}
