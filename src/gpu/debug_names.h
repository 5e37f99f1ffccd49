// Names in captures and validation messages (VK_EXT_debug_utils), wherever that extension is there.
#pragma once

#include <string>
#include <utility>

#include "gpu/vulkan.h"

namespace scumble::gpu {

// A name; of what has none of its own, where it is made: "world/draw_list.cpp:42".
class DebugName {
 public:
  DebugName() = default;
  DebugName(std::string name) : name_(std::move(name)) {}
  DebugName(const char* file, int line) : file_(file), line_(line) {}
  std::string text() const;

 private:
  std::string name_;
  const char* file_ = "";
  int line_ = 0;
};
// Place of a call, as the default of its last argument. (Clang 14 has no std::source_location.)
#define SCUMBLE_CALLER ::scumble::gpu::DebugName(__builtin_FILE(), __builtin_LINE())

// The extension's functions; all null where it is not there.
struct DebugUtils {
  PFN_vkSetDebugUtilsObjectNameEXT setName = nullptr;
  PFN_vkCmdBeginDebugUtilsLabelEXT beginLabel = nullptr;
  PFN_vkCmdEndDebugUtilsLabelEXT endLabel = nullptr;
  PFN_vkQueueBeginDebugUtilsLabelEXT beginQueueLabel = nullptr;
  PFN_vkQueueEndDebugUtilsLabelEXT endQueueLabel = nullptr;
};
// Functions of a device whose instance has the extension; null for others.
DebugUtils debugUtilsOf(VkInstance instance, VkDevice device);

// Around what is recorded while it lives.
class DebugLabel {
 public:
  DebugLabel(const DebugUtils& utils, VkCommandBuffer commands, const std::string& name);
  ~DebugLabel();
  DebugLabel(const DebugLabel&) = delete;
  DebugLabel& operator=(const DebugLabel&) = delete;

 private:
  const DebugUtils& utils_;
  VkCommandBuffer commands_;
};

}  // namespace scumble::gpu
