#include "xr/instance.h"

#include <algorithm>
#include <cstring>

#include "scumble/version.h"
#include "xr/failure.h"

namespace scumble::xr {

namespace {

constexpr uint32_t kVersion =
    (SCUMBLE_VERSION_MAJOR << 16) | (SCUMBLE_VERSION_MINOR << 8) | SCUMBLE_VERSION_PATCH;

// Used where they are there.
const char* const kWelcome[] = {XR_FB_DISPLAY_REFRESH_RATE_EXTENSION_NAME,
                                kUserPresenceExtension,
                                XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME,
                                kFrameSynthesisExtension,
                                XR_FB_SPACE_WARP_EXTENSION_NAME,
                                XR_VARJO_QUAD_VIEWS_EXTENSION_NAME};

std::map<std::string, uint32_t> extensionsThere(const Functions& call) {
  std::map<std::string, uint32_t> versions;
  for (const XrExtensionProperties& extension : listed<XrExtensionProperties>(
           "xrEnumerateInstanceExtensionProperties",
           [&](uint32_t capacity, uint32_t*count, XrExtensionProperties*all) {
             return call.EnumerateInstanceExtensionProperties(nullptr, capacity, count, all);
           },
           {XR_TYPE_EXTENSION_PROPERTIES}))
    versions[extension.extensionName] = std::max(extension.extensionVersion, 1u);
  return versions;
}

// What the runtime makes for Vulkan.
template <class T, class Make>
Result<T> made(const char* what, const Make& make) {
  try {
    T thing = VK_NULL_HANDLE;
    VkResult result = VK_SUCCESS;
    make(&thing, &result);
    if (result == VK_SUCCESS && thing) return thing;
    return Error{ErrorKind::noUsableGpu,
                 "",
                 0,
                 "",
                 std::string("the headset's runtime has not made ") + what + " of Vulkan (VkResult " +
                     std::to_string(int(result)) + ")",
                 "see `scumble devices`"};
  } catch (const XrFailure& failure) {
    return errorOf(failure);
  }
}

}  // namespace

Result<std::unique_ptr<Instance>> Instance::create() {
  Result<Functions> functions = Functions::open();
  if (!functions) return functions.error();
  std::unique_ptr<Instance> instance(new Instance);
  instance->call_ = *functions;
  try {
    const std::map<std::string, uint32_t> there = extensionsThere(instance->call_);
    if (!there.count(XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME))
      return Error{ErrorKind::noUsableGpu,
                   "",
                   0,
                   "",
                   "the OpenXR runtime does not take Vulkan (XR_KHR_vulkan_enable2)",
                   "choose another runtime by XR_RUNTIME_JSON"};
    std::vector<const char*> names{XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME};
    for (const char* const name : kWelcome)
      if (there.count(name)) names.push_back(name);
    for (const char* const name : names) instance->extensions_[name] = there.at(name);
    XrInstanceCreateInfo info{XR_TYPE_INSTANCE_CREATE_INFO};
    std::strncpy(info.applicationInfo.applicationName, "scumble", XR_MAX_APPLICATION_NAME_SIZE - 1);
    std::strncpy(info.applicationInfo.engineName, "scumble", XR_MAX_ENGINE_NAME_SIZE - 1);
    info.applicationInfo.applicationVersion = info.applicationInfo.engineVersion = kVersion;
    info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
    info.enabledExtensionCount = uint32_t(names.size());
    info.enabledExtensionNames = names.data();
    must(instance->call_.CreateInstance(&info, &instance->instance_), "xrCreateInstance");
    instance->call_.load(instance->instance_);
    XrInstanceProperties properties{XR_TYPE_INSTANCE_PROPERTIES};
    must(instance->call_.GetInstanceProperties(instance->instance_, &properties), "xrGetInstanceProperties");
    const XrVersion version = properties.runtimeVersion;
    instance->runtime_ =
        std::string(properties.runtimeName) + " " + std::to_string(XR_VERSION_MAJOR(version)) + "." +
        std::to_string(XR_VERSION_MINOR(version)) + "." + std::to_string(XR_VERSION_PATCH(version));
  } catch (const XrFailure& failure) {
    return errorOf(failure);
  }
  return instance;
}

Instance::~Instance() {
  if (instance_ && call_.DestroyInstance) call_.DestroyInstance(instance_);
}

uint32_t Instance::version(const std::string& extension) const {
  const auto found = extensions_.find(extension);
  return found == extensions_.end() ? 0 : found->second;
}

void Instance::findHeadset() {
  const XrSystemGetInfo wanted{XR_TYPE_SYSTEM_GET_INFO, nullptr, XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY};
  must(call_.GetSystem(instance_, &wanted, &system_), "xrGetSystem");
  XrSystemProperties properties{XR_TYPE_SYSTEM_PROPERTIES};
  XrSystemSpaceWarpPropertiesFB warp{XR_TYPE_SYSTEM_SPACE_WARP_PROPERTIES_FB};
  if (has(XR_FB_SPACE_WARP_EXTENSION_NAME)) properties.next = &warp;
  must(call_.GetSystemProperties(instance_, system_, &properties), "xrGetSystemProperties");
  headset_ = properties.systemName;
  motionSize_ = {warp.recommendedMotionVectorImageRectWidth, warp.recommendedMotionVectorImageRectHeight};
  // Runtimes want to be asked before they make anything for Vulkan.
  XrGraphicsRequirementsVulkan2KHR needs{XR_TYPE_GRAPHICS_REQUIREMENTS_VULKAN2_KHR};
  must(call_.GetVulkanGraphicsRequirements2KHR(instance_, system_, &needs),
       "xrGetVulkanGraphicsRequirements2KHR");
  if (needs.minApiVersionSupported >= XR_MAKE_VERSION(1, 4, 0))
    throw XrFailure("xrGetVulkanGraphicsRequirements2KHR", XR_ERROR_API_VERSION_UNSUPPORTED);
}

VulkanWishes Instance::vulkan() const {
  VulkanWishes wishes;
  wishes.createInstance = [this](const VkInstanceCreateInfo& info) -> Result<VkInstance> {
    XrVulkanInstanceCreateInfoKHR wanted{XR_TYPE_VULKAN_INSTANCE_CREATE_INFO_KHR};
    wanted.systemId = system_;
    wanted.pfnGetInstanceProcAddr = &vkGetInstanceProcAddr;
    wanted.vulkanCreateInfo = &info;
    return made<VkInstance>("an instance", [&](VkInstance* instance, VkResult* result) {
      must(call_.CreateVulkanInstanceKHR(instance_, &wanted, instance, result), "xrCreateVulkanInstanceKHR");
    });
  };
  wishes.choosePhysical = [this](VkInstance instance) -> Result<VkPhysicalDevice> {
    XrVulkanGraphicsDeviceGetInfoKHR wanted{XR_TYPE_VULKAN_GRAPHICS_DEVICE_GET_INFO_KHR};
    wanted.systemId = system_;
    wanted.vulkanInstance = instance;
    return made<VkPhysicalDevice>("a choice of device", [&](VkPhysicalDevice* physical, VkResult*) {
      must(call_.GetVulkanGraphicsDevice2KHR(instance_, &wanted, physical), "xrGetVulkanGraphicsDevice2KHR");
    });
  };
  wishes.createDevice = [this](VkPhysicalDevice physical,
                               const VkDeviceCreateInfo& info) -> Result<VkDevice> {
    XrVulkanDeviceCreateInfoKHR wanted{XR_TYPE_VULKAN_DEVICE_CREATE_INFO_KHR};
    wanted.systemId = system_;
    wanted.pfnGetInstanceProcAddr = &vkGetInstanceProcAddr;
    wanted.vulkanPhysicalDevice = physical;
    wanted.vulkanCreateInfo = &info;
    return made<VkDevice>("a device", [&](VkDevice* device, VkResult* result) {
      must(call_.CreateVulkanDeviceKHR(instance_, &wanted, device, result), "xrCreateVulkanDeviceKHR");
    });
  };
  // Runtimes may wait and signal on timelines of the program's device.
  wishes.features = [](VulkanFeatures& features) { features.timelineSemaphore.timelineSemaphore = VK_TRUE; };
  return wishes;
}

}  // namespace scumble::xr
