#include "gpu/debug_names.h"

#include <string_view>
#include <type_traits>

namespace scumble::gpu {

std::string DebugName::text() const {
  if (!name_.empty()) return name_;
  std::string_view file = file_;
  if (const size_t src = file.rfind("src/"); src != file.npos) file.remove_prefix(src + 4);
  return std::string(file) + ":" + std::to_string(line_);
}

DebugUtils debugUtilsOf(VkInstance instance, VkDevice device) {
  DebugUtils utils;
  // Loaders give device functions of extensions that are off, too: those of the instance tell.
  if (!vkGetInstanceProcAddr(instance, "vkCreateDebugUtilsMessengerEXT")) return utils;
  const auto load = [&](auto& function, const char* name) {
    function =
        reinterpret_cast<std::remove_reference_t<decltype(function)>>(vkGetDeviceProcAddr(device, name));
  };
  load(utils.setName, "vkSetDebugUtilsObjectNameEXT");
  load(utils.beginLabel, "vkCmdBeginDebugUtilsLabelEXT");
  load(utils.endLabel, "vkCmdEndDebugUtilsLabelEXT");
  load(utils.beginQueueLabel, "vkQueueBeginDebugUtilsLabelEXT");
  load(utils.endQueueLabel, "vkQueueEndDebugUtilsLabelEXT");
  const bool isWhole =
      utils.setName && utils.beginLabel && utils.endLabel && utils.beginQueueLabel && utils.endQueueLabel;
  return isWhole ? utils : DebugUtils();
}

DebugLabel::DebugLabel(const DebugUtils& utils, VkCommandBuffer commands, const std::string& name)
    : utils_(utils), commands_(commands) {
  if (!utils_.beginLabel) return;
  VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
  label.pLabelName = name.c_str();
  utils_.beginLabel(commands_, &label);
}

DebugLabel::~DebugLabel() {
  if (utils_.endLabel) utils_.endLabel(commands_);
}

}  // namespace scumble::gpu
