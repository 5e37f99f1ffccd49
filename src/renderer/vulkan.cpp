#include "scumble/vulkan.h"

#include <algorithm>

#include "gpu/debug_names.h"
#include "renderer/impl.h"

namespace scumble {

using namespace renderer;

Result<std::unique_ptr<Renderer>> createRenderer(const VulkanWishes& wishes, const RendererOptions& options) {
  gpu::DeviceOptions deviceOptions;
  deviceOptions.choice = options.device;
  deviceOptions.validation = options.validation;
  deviceOptions.cacheFolder = options.cacheFolder;
  deviceOptions.log = options.log;
  deviceOptions.wishes = &wishes;
  return RendererAccess::create(gpu::Device::create(deviceOptions), options);
}

Result<std::unique_ptr<Renderer>> createRenderer(const VulkanDevice& device, const RendererOptions& options) {
  if (!device.instance || !device.physical || !device.device || !device.queue)
    return usage("a part of the device is null", "give instance, physical device, device and queue");
  return RendererAccess::create(gpu::Device::adopt(device, options.cacheFolder, options.log), options);
}

VulkanDevice vulkanDeviceOf(const Renderer& renderer) {
  const gpu::Device& device = RendererAccess::device(renderer);
  return {device.instance(), device.physical(),    device.handle(),
          device.queue(),    device.queueFamily(), &device.queueLock()};
}

void nameVulkanObject(const VulkanDevice& device, VkObjectType type, uint64_t handle,
                      const std::string& name) {
  const gpu::DebugUtils utils = gpu::debugUtilsOf(device.instance, device.device);
  if (!utils.setName) return;
  VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT};
  info.objectType = type, info.objectHandle = handle, info.pObjectName = name.c_str();
  utils.setName(device.device, &info);
}

namespace {

Status checkTarget(const VulkanTarget& target, const std::vector<View>& views, const RenderOptions& options) {
  if (!target.image) return usage("a target has no image", "give each one");
  if (target.view >= views.size()) return usage("a target is of a view that the frame does not have", "");
  if (!isTargetFormat(target.format, target.aov))
    return usage("a target has a format that frames do not go into",
                 target.aov.empty() ? "see VulkanTarget::format" : "AOVs need half or full floats");
  const View& view = views[target.view];
  const glm::uvec2 size = view.size == glm::uvec2(0) ? glm::uvec2(options.width, options.height) : view.size;
  if (target.offset.x < 0 || target.offset.y < 0 ||
      uint64_t(target.offset.x) + size.x > target.extent.width ||
      uint64_t(target.offset.y) + size.y > target.extent.height)
    return usage("a view's rectangle reaches out of its target",
                 "it has the view's size; see VulkanTarget::offset");
  if (target.motion != MotionUnit::pixels && target.aov != "motion")
    return usage("a target that is not of motion has a unit of it", "see VulkanTarget::motion");
  if (!target.aov.empty() && (Renderer::hasSizeOfItsOwn(target.aov) || target.aov == "blur"))
    return usage("the AOV '" + target.aov + "' has a size of its own", "read it back instead");
  return Done{};
}

}  // namespace

Status begin(Renderer& renderer, const Scene& scene, const Look& look, double time,
             const std::vector<View>& views, const RenderOptions& options, const VulkanTargets& targets) {
  Delivery delivery;
  delivery.waits = targets.waits, delivery.signals = targets.signals;
  delivery.readbacks = targets.readbacks;
  for (const VulkanReadback& readback : targets.readbacks)
    if (readback.view >= views.size()) return usage("a view is read back that the frame does not have", "");
  for (const VulkanTarget& target : targets.images) {
    if (Status status = checkTarget(target, views, options); !status) return status;
    TargetKey key;
    key.format = target.format;
    key.width = target.extent.width, key.height = target.extent.height, key.layer = target.layer;
    key.x = target.offset.x, key.y = target.offset.y;
    key.before = target.before, key.after = target.after;
    key.aov = target.aov, key.motion = target.motion;
    for (const Delivery::Target& other : delivery.targets)
      if (other.image == target.image &&
          (other.key.format != key.format || other.key.width != key.width || other.key.height != key.height ||
           other.key.before != key.before || other.key.after != key.after))
        return usage("targets in one image differ in format, extent or layouts", "give them the same ones");
    delivery.targets.push_back({target.view, key, target.image});
  }
  return RendererAccess::begin(renderer, {scene, look.data(), time, views, options, &delivery});
}

}  // namespace scumble
