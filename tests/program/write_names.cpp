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

// vkCreateBuffer and its like.
template <VkObjectType kKind, class Function, class Info, class Handle>
VkResult create(const char* name, VkDevice device, const Info* info, const VkAllocationCallbacks* allocator,
                Handle* handle) {
  const VkResult result = layer::next<Function>(device, name)(device, info, allocator, handle);
  if (result == VK_SUCCESS) made(kKind, *handle);
  return result;
}
VKAPI_ATTR VkResult VKAPI_CALL createBuffer(VkDevice device, const VkBufferCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkBuffer* buffer) {
  return create<VK_OBJECT_TYPE_BUFFER, PFN_vkCreateBuffer>("vkCreateBuffer", device, info, allocator, buffer);
}
VKAPI_ATTR VkResult VKAPI_CALL createImage(VkDevice device, const VkImageCreateInfo* info,
                                           const VkAllocationCallbacks* allocator, VkImage* image) {
  return create<VK_OBJECT_TYPE_IMAGE, PFN_vkCreateImage>("vkCreateImage", device, info, allocator, image);
}

template <class Function, class Info>
VkResult createPipelines(const char* name, VkDevice device, VkPipelineCache cache, uint32_t count,
                         const Info* infos, const VkAllocationCallbacks* allocator, VkPipeline* pipelines) {
  const VkResult result =
      layer::next<Function>(device, name)(device, cache, count, infos, allocator, pipelines);
  for (uint32_t i = 0; i < count && result == VK_SUCCESS; ++i) made(VK_OBJECT_TYPE_PIPELINE, pipelines[i]);
  return result;
}
VKAPI_ATTR VkResult VKAPI_CALL createGraphicsPipelines(VkDevice device, VkPipelineCache cache, uint32_t count,
                                                       const VkGraphicsPipelineCreateInfo* infos,
                                                       const VkAllocationCallbacks* allocator,
                                                       VkPipeline* pipelines) {
  return createPipelines<PFN_vkCreateGraphicsPipelines>("vkCreateGraphicsPipelines", device, cache, count,
                                                        infos, allocator, pipelines);
}
VKAPI_ATTR VkResult VKAPI_CALL createComputePipelines(VkDevice device, VkPipelineCache cache, uint32_t count,
                                                      const VkComputePipelineCreateInfo* infos,
                                                      const VkAllocationCallbacks* allocator,
                                                      VkPipeline* pipelines) {
  return createPipelines<PFN_vkCreateComputePipelines>("vkCreateComputePipelines", device, cache, count,
                                                       infos, allocator, pipelines);
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

std::vector<layer::Function> layer::intercepted() {
  return {{"vkCreateBuffer", createBuffer},
          {"vkCreateImage", createImage},
          {"vkCreateGraphicsPipelines", createGraphicsPipelines},
          {"vkCreateComputePipelines", createComputePipelines},
          {"vkSetDebugUtilsObjectNameEXT", setName},
          {"vkCmdBeginDebugUtilsLabelEXT", beginLabel},
          {"vkCmdEndDebugUtilsLabelEXT", endLabel},
          {"vkQueueBeginDebugUtilsLabelEXT", beginQueueLabel},
          {"vkQueueEndDebugUtilsLabelEXT", endQueueLabel},
          {"vkQueueSubmit2", queueSubmit2}};
}
