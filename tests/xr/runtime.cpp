#include "runtime.h"

#include <cstdlib>
#include <fstream>

namespace scumble::test {

Runtime& runtime() {
  static Runtime made;
  return made;
}

// What the script makes of a call; each is written down.
XrResult begun(const char* call) {
  Runtime& r = runtime();
  r.report["calls"].push_back(call);
  const Json fail = r.script.value("fail", Json::object());
  if (!fail.contains(call)) return XR_SUCCESS;
  const Json& how = fail[call];
  if (how.is_number()) return XrResult(how.get<int>());
  if (++r.failing[call] >= how[1].get<int>()) return XrResult(how[0].get<int>());
  return XR_SUCCESS;
}
void post(const void* event, size_t size) {
  XrEventDataBuffer buffer{XR_TYPE_EVENT_DATA_BUFFER};
  std::memcpy(static_cast<void*>(&buffer), event, size);
  runtime().events.push_back(buffer);
}

void goTo(XrSessionState state) {
  runtime().state = state;
  const XrEventDataSessionStateChanged event{XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED, nullptr, kSession,
                                             state, 1};
  post(&event, sizeof event);
}

namespace {

// The loader's side of a runtime, which Debian's headers leave out.
struct NegotiateLoaderInfo {
  int structType;
  uint32_t structVersion;
  size_t structSize;
  uint32_t minInterfaceVersion, maxInterfaceVersion;
  XrVersion minApiVersion, maxApiVersion;
};
struct NegotiateRuntimeRequest {
  int structType;
  uint32_t structVersion;
  size_t structSize;
  uint32_t runtimeInterfaceVersion;
  XrVersion runtimeApiVersion;
  PFN_xrGetInstanceProcAddr getInstanceProcAddr;
};

// ---- Instance

XrResult XRAPI_CALL enumerateInstanceExtensionProperties(const char*, uint32_t capacity, uint32_t* count,
                                                         XrExtensionProperties* out) {
  BEGIN("xrEnumerateInstanceExtensionProperties");
  std::vector<std::string> names;
  if (r.script.value("vulkan", true)) names.emplace_back(XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME);
  if (r.script.value("depth", false)) names.emplace_back(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME);
  if (r.offersRates()) names.emplace_back(XR_FB_DISPLAY_REFRESH_RATE_EXTENSION_NAME);
  if (r.hasInsets()) names.emplace_back(XR_VARJO_QUAD_VIEWS_EXTENSION_NAME);
  if (r.synthesis() == "ext" || r.synthesis() == "both") names.emplace_back(kFrameSynthesisExtension);
  if (r.synthesis() == "fb" || r.synthesis() == "both") names.emplace_back(XR_FB_SPACE_WARP_EXTENSION_NAME);
  names.emplace_back(kUserPresenceExtension);
  std::vector<XrExtensionProperties> all;
  for (const std::string& name : names) {
    XrExtensionProperties& one = all.emplace_back(XrExtensionProperties{XR_TYPE_EXTENSION_PROPERTIES});
    std::strncpy(one.extensionName, name.c_str(), XR_MAX_EXTENSION_NAME_SIZE - 1);
    one.extensionVersion = name == XR_FB_SPACE_WARP_EXTENSION_NAME ? r.script.value("fbVersion", 2u) : 1;
  }
  for (uint32_t i = 0; i < capacity; ++i)
    NEED(out[i].type == XR_TYPE_EXTENSION_PROPERTIES, "an extension's structure has no type",
         XR_ERROR_VALIDATION_FAILURE);
  return give(all, capacity, count, out);
}

XrResult XRAPI_CALL createInstance(const XrInstanceCreateInfo* info, XrInstance* instance) {
  BEGIN("xrCreateInstance");
  NEED(!r.hasInstance, "a second instance", XR_ERROR_LIMIT_REACHED);
  for (uint32_t i = 0; i < info->enabledExtensionCount; ++i)
    r.extensions.insert(info->enabledExtensionNames[i]);
  r.hasInstance = true;
  *instance = kInstance;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL destroyInstance(XrInstance) {
  BEGIN("xrDestroyInstance");
  NEED(!r.hasSession, "the instance is destroyed before its session", XR_SUCCESS);
  r.hasInstance = false;
  r.report["ended"] = true;
  r.write();
  return XR_SUCCESS;
}

XrResult XRAPI_CALL getInstanceProperties(XrInstance, XrInstanceProperties* properties) {
  BEGIN("xrGetInstanceProperties");
  properties->runtimeVersion = XR_MAKE_VERSION(1, 2, 3);
  std::strcpy(properties->runtimeName, "Test runtime");
  return XR_SUCCESS;
}

XrResult XRAPI_CALL pollEvent(XrInstance, XrEventDataBuffer* event) {
  Runtime& r = runtime();
  NEED(event->type == XR_TYPE_EVENT_DATA_BUFFER, "xrPollEvent gets no buffer", XR_ERROR_VALIDATION_FAILURE);
  if (r.events.empty()) return XR_EVENT_UNAVAILABLE;
  *event = r.events.front();
  r.events.pop_front();
  return XR_SUCCESS;
}

XrResult XRAPI_CALL getSystem(XrInstance, const XrSystemGetInfo* info, XrSystemId* system) {
  BEGIN("xrGetSystem");
  NEED(info->formFactor == XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY, "no headset is asked for",
       XR_ERROR_FORM_FACTOR_UNSUPPORTED);
  if (!r.script.value("headset", true)) return XR_ERROR_FORM_FACTOR_UNAVAILABLE;
  if (r.isLost && ++r.searches <= r.script.value("comesBack", 0)) return XR_ERROR_FORM_FACTOR_UNAVAILABLE;
  *system = kSystem;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL getSystemProperties(XrInstance, XrSystemId, XrSystemProperties* properties) {
  BEGIN("xrGetSystemProperties");
  std::strcpy(properties->systemName, "Cardboard head");
  if (auto* const warp = static_cast<XrSystemSpaceWarpPropertiesFB*>(properties->next)) {
    NEED(warp->type == XR_TYPE_SYSTEM_SPACE_WARP_PROPERTIES_FB &&
             r.extensions.count(XR_FB_SPACE_WARP_EXTENSION_NAME),
         "properties of something unknown", XR_ERROR_VALIDATION_FAILURE);
    warp->recommendedMotionVectorImageRectWidth = r.motionSize()[0];
    warp->recommendedMotionVectorImageRectHeight = r.motionSize()[1];
  }
  return XR_SUCCESS;
}

XrResult XRAPI_CALL enumerateViewConfigurations(XrInstance, XrSystemId, uint32_t capacity, uint32_t* count,
                                                XrViewConfigurationType* out) {
  BEGIN("xrEnumerateViewConfigurations");
  std::vector<XrViewConfigurationType> all{XR_VIEW_CONFIGURATION_TYPE_PRIMARY_MONO,
                                           XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO};
  if (r.isOfFour()) all.insert(all.begin(), r.views());
  return give(all, capacity, count, out);
}

XrResult XRAPI_CALL enumerateViewConfigurationViews(XrInstance, XrSystemId, XrViewConfigurationType type,
                                                    uint32_t capacity, uint32_t* count,
                                                    XrViewConfigurationView* out) {
  BEGIN("xrEnumerateViewConfigurationViews");
  const auto size = r.script.value("size", std::array<uint32_t, 2>{64, 64});
  NEED(type == r.views(), "not the views that it likes best", XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED);
  *count = r.viewCount();
  if (capacity == 0) return XR_SUCCESS;
  NEED(capacity >= r.viewCount(), "too few views", XR_ERROR_SIZE_INSUFFICIENT);
  for (size_t eye = 0; eye < r.viewCount(); ++eye) {
    NEED(out[eye].type == XR_TYPE_VIEW_CONFIGURATION_VIEW, "a view's structure has no type",
         XR_ERROR_VALIDATION_FAILURE);
    const auto own = eye < 2 ? size : r.script["insets"]["size"].get<std::array<uint32_t, 2>>();
    out[eye] = {out[eye].type, out[eye].next, own[0], 4096, own[1], 4096, 1, 4};
    auto* const motion = static_cast<XrFrameSynthesisConfigView*>(out[eye].next);
    if (!motion) continue;
    NEED(motion->type == kTypeFrameSynthesisConfigView && r.extensions.count(kFrameSynthesisExtension),
         "a view of something unknown", XR_ERROR_VALIDATION_FAILURE);
    motion->recommendedMotionVectorImageRectWidth = r.motionSize()[0];
    motion->recommendedMotionVectorImageRectHeight = r.motionSize()[1];
  }
  return XR_SUCCESS;
}

XrResult XRAPI_CALL enumerateEnvironmentBlendModes(XrInstance, XrSystemId, XrViewConfigurationType,
                                                   uint32_t capacity, uint32_t* count,
                                                   XrEnvironmentBlendMode* out) {
  BEGIN("xrEnumerateEnvironmentBlendModes");
  return give<XrEnvironmentBlendMode>({XR_ENVIRONMENT_BLEND_MODE_OPAQUE}, capacity, count, out);
}

// ---- Vulkan

XrResult XRAPI_CALL getVulkanGraphicsRequirements2(XrInstance, XrSystemId,
                                                   XrGraphicsRequirementsVulkan2KHR* needs) {
  BEGIN("xrGetVulkanGraphicsRequirements2KHR");
  NEED(r.extensions.count(XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME) == 1, "Vulkan without its extension",
       XR_ERROR_FUNCTION_UNSUPPORTED);
  r.askedRequirements = true;
  needs->minApiVersionSupported = XR_MAKE_VERSION(1, 0, 0);
  needs->maxApiVersionSupported = XR_MAKE_VERSION(1, 3, 0);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL createVulkanInstance(XrInstance, const XrVulkanInstanceCreateInfoKHR* info,
                                         VkInstance* instance, VkResult* result) {
  BEGIN("xrCreateVulkanInstanceKHR");
  NEED(r.askedRequirements, "Vulkan's instance before its requirements",
       XR_ERROR_GRAPHICS_REQUIREMENTS_CALL_MISSING);
  const auto create =
      reinterpret_cast<PFN_vkCreateInstance>(info->pfnGetInstanceProcAddr(nullptr, "vkCreateInstance"));
  *result = create(info->vulkanCreateInfo, info->vulkanAllocator, instance);
  r.vulkan = *instance;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL getVulkanGraphicsDevice2(XrInstance, const XrVulkanGraphicsDeviceGetInfoKHR* info,
                                             VkPhysicalDevice* physical) {
  BEGIN("xrGetVulkanGraphicsDevice2KHR");
  NEED(info->vulkanInstance == r.vulkan, "a device of another instance", XR_ERROR_VALIDATION_FAILURE);
  uint32_t count = 1;
  vkEnumeratePhysicalDevices(info->vulkanInstance, &count, physical);
  r.physical = *physical;
  return count == 1 ? XR_SUCCESS : XR_ERROR_RUNTIME_FAILURE;
}

XrResult XRAPI_CALL createVulkanDevice(XrInstance, const XrVulkanDeviceCreateInfoKHR* info, VkDevice* device,
                                       VkResult* result) {
  BEGIN("xrCreateVulkanDeviceKHR");
  NEED(info->vulkanPhysicalDevice == r.physical, "not the runtime's device", XR_ERROR_VALIDATION_FAILURE);
  // A runtime that synchronises by timelines needs the program to switch them on, looks for the feature's own
  // structure, and puts structures of its own before the others, as public ones do.
  bool hasTimelines = false;
  for (auto* next = static_cast<const VkBaseInStructure*>(info->vulkanCreateInfo->pNext); next;
       next = next->pNext)
    if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES)
      hasTimelines =
          reinterpret_cast<const VkPhysicalDeviceTimelineSemaphoreFeatures*>(next)->timelineSemaphore;
  NEED(hasTimelines, "timeline semaphores are not switched on", XR_ERROR_VALIDATION_FAILURE);
  const auto create =
      reinterpret_cast<PFN_vkCreateDevice>(info->pfnGetInstanceProcAddr(r.vulkan, "vkCreateDevice"));
  VkPhysicalDeviceHostQueryResetFeatures own{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_HOST_QUERY_RESET_FEATURES,
                                             const_cast<void*>(info->vulkanCreateInfo->pNext), VK_TRUE};
  VkDeviceCreateInfo createInfo = *info->vulkanCreateInfo;
  createInfo.pNext = &own;
  *result = create(info->vulkanPhysicalDevice, &createInfo, info->vulkanAllocator, device);
  r.device = *device;
  return XR_SUCCESS;
}

// ---- Session

XrResult XRAPI_CALL createSession(XrInstance, const XrSessionCreateInfo* info, XrSession* session) {
  BEGIN("xrCreateSession");
  NEED(!r.hasSession, "a second session", XR_ERROR_LIMIT_REACHED);
  const auto* const binding = static_cast<const XrGraphicsBindingVulkan2KHR*>(info->next);
  NEED(binding && binding->type == XR_TYPE_GRAPHICS_BINDING_VULKAN2_KHR, "a session without Vulkan",
       XR_ERROR_GRAPHICS_DEVICE_INVALID);
  NEED(binding->instance == r.vulkan && binding->physicalDevice == r.physical && binding->device == r.device,
       "a session on another device", XR_ERROR_GRAPHICS_DEVICE_INVALID);
  r.family = binding->queueFamilyIndex;
  vkGetDeviceQueue(r.device, r.family, binding->queueIndex, &r.queue);
  r.hasSession = true, r.isRunning = false, r.isLost = false, r.searches = 0;
  *session = kSession;
  goTo(XR_SESSION_STATE_IDLE);
  goTo(XR_SESSION_STATE_READY);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL destroySession(XrSession) {
  BEGIN("xrDestroySession");
  NEED(!r.isBegun || r.mayFail("xrEndFrame"), "a session is destroyed within a frame", XR_SUCCESS);
  // What it had to say is of nobody any more.
  r.events.clear();
  NEED(r.spaces.empty() && r.swapchains.empty(), "a session's spaces and swapchains outlive it", XR_SUCCESS);
  r.hasSession = r.isRunning = r.isWaited = r.isBegun = r.isAttached = false;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL beginSession(XrSession, const XrSessionBeginInfo* info) {
  BEGIN("xrBeginSession");
  NEED(r.state == XR_SESSION_STATE_READY, "a session is begun that is not ready", XR_ERROR_SESSION_NOT_READY);
  NEED(info->primaryViewConfigurationType == r.views(), "a session of other views",
       XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED);
  r.isRunning = true;
  goTo(XR_SESSION_STATE_SYNCHRONIZED);
  goTo(XR_SESSION_STATE_VISIBLE);
  goTo(XR_SESSION_STATE_FOCUSED);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL endSession(XrSession) {
  BEGIN("xrEndSession");
  NEED(r.state == XR_SESSION_STATE_STOPPING, "a session is ended that is not stopping",
       XR_ERROR_SESSION_NOT_STOPPING);
  NEED(!r.isBegun, "a session is ended within a frame", XR_SUCCESS);
  r.isRunning = r.isWaited = false;
  goTo(XR_SESSION_STATE_IDLE);
  goTo(r.wantsExit ? XR_SESSION_STATE_EXITING : XR_SESSION_STATE_READY);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL requestExitSession(XrSession) {
  BEGIN("xrRequestExitSession");
  NEED(r.isRunning, "an end is asked for of what does not run", XR_ERROR_SESSION_NOT_RUNNING);
  if (r.script.value("mute", false)) return XR_SUCCESS;
  r.wantsExit = true;
  goTo(XR_SESSION_STATE_VISIBLE);
  goTo(XR_SESSION_STATE_SYNCHRONIZED);
  goTo(XR_SESSION_STATE_STOPPING);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL enumerateReferenceSpaces(XrSession, uint32_t capacity, uint32_t* count,
                                             XrReferenceSpaceType* out) {
  BEGIN("xrEnumerateReferenceSpaces");
  std::vector<XrReferenceSpaceType> all{XR_REFERENCE_SPACE_TYPE_VIEW, XR_REFERENCE_SPACE_TYPE_LOCAL};
  if (r.script.value("stage", true)) all.push_back(XR_REFERENCE_SPACE_TYPE_STAGE);
  return give(all, capacity, count, out);
}

XrResult XRAPI_CALL createReferenceSpace(XrSession, const XrReferenceSpaceCreateInfo* info, XrSpace* space) {
  BEGIN("xrCreateReferenceSpace");
  auto* const made = new Space{info->referenceSpaceType, ""};
  r.spaces.insert(made);
  *space = reinterpret_cast<XrSpace>(made);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL destroySpace(XrSpace space) {
  BEGIN("xrDestroySpace");
  auto* const old = reinterpret_cast<Space*>(space);
  NEED(r.spaces.erase(old) == 1, "a space is destroyed twice", XR_ERROR_HANDLE_INVALID);
  delete old;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL enumerateRates(XrSession, uint32_t capacity, uint32_t* count, float* out) {
  BEGIN("xrEnumerateDisplayRefreshRatesFB");
  return give(r.script["refreshRates"].get<std::vector<float>>(), capacity, count, out);
}

XrResult XRAPI_CALL getRate(XrSession, float* rate) {
  BEGIN("xrGetDisplayRefreshRateFB");
  *rate = r.refreshRate;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL requestRate(XrSession, float rate) {
  BEGIN("xrRequestDisplayRefreshRateFB");
  const auto rates = r.script["refreshRates"].get<std::vector<float>>();
  NEED(std::find(rates.begin(), rates.end(), rate) != rates.end(), "a rate that is not offered",
       XR_ERROR_DISPLAY_REFRESH_RATE_UNSUPPORTED_FB);
  r.refreshRate = rate;
  r.report["refreshRate"] = rate;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL getInstanceProcAddr(XrInstance, const char* name, PFN_xrVoidFunction* function) {
  static const auto kAll = [] {
    std::map<std::string, PFN_xrVoidFunction> all{
        ENTRY(GetInstanceProcAddr, getInstanceProcAddr),
        ENTRY(EnumerateInstanceExtensionProperties, enumerateInstanceExtensionProperties),
        ENTRY(CreateInstance, createInstance),
        ENTRY(DestroyInstance, destroyInstance),
        ENTRY(GetInstanceProperties, getInstanceProperties),
        ENTRY(PollEvent, pollEvent),
        ENTRY(GetSystem, getSystem),
        ENTRY(GetSystemProperties, getSystemProperties),
        ENTRY(EnumerateViewConfigurations, enumerateViewConfigurations),
        ENTRY(EnumerateViewConfigurationViews, enumerateViewConfigurationViews),
        ENTRY(EnumerateEnvironmentBlendModes, enumerateEnvironmentBlendModes),
        ENTRY(GetVulkanGraphicsRequirements2KHR, getVulkanGraphicsRequirements2),
        ENTRY(CreateVulkanInstanceKHR, createVulkanInstance),
        ENTRY(GetVulkanGraphicsDevice2KHR, getVulkanGraphicsDevice2),
        ENTRY(CreateVulkanDeviceKHR, createVulkanDevice),
        ENTRY(CreateSession, createSession),
        ENTRY(DestroySession, destroySession),
        ENTRY(BeginSession, beginSession),
        ENTRY(EndSession, endSession),
        ENTRY(RequestExitSession, requestExitSession),
        ENTRY(EnumerateReferenceSpaces, enumerateReferenceSpaces),
        ENTRY(CreateReferenceSpace, createReferenceSpace),
        ENTRY(DestroySpace, destroySpace),
        ENTRY(EnumerateDisplayRefreshRatesFB, enumerateRates),
        ENTRY(GetDisplayRefreshRateFB, getRate),
        ENTRY(RequestDisplayRefreshRateFB, requestRate),
    };
    for (const auto& calls : {imageCalls(), handCalls(), frameCalls()})
      all.insert(calls.begin(), calls.end());
    return all;
  }();
  const auto found = kAll.find(name);
  const bool isRate = std::strstr(name, "RefreshRate");
  *function = found == kAll.end() || (isRate && !runtime().offersRates()) ? nullptr : found->second;
  return *function ? XR_SUCCESS : XR_ERROR_FUNCTION_UNSUPPORTED;
}

}  // namespace

}  // namespace scumble::test

extern "C" __attribute__((visibility("default"))) XrResult xrNegotiateLoaderRuntimeInterface(
    const scumble::test::NegotiateLoaderInfo* info, scumble::test::NegotiateRuntimeRequest* request) {
  if (info->minInterfaceVersion > 1 || info->maxInterfaceVersion < 1) return XR_ERROR_INITIALIZATION_FAILED;
  request->runtimeInterfaceVersion = 1;
  request->runtimeApiVersion = XR_MAKE_VERSION(1, 0, 20);
  request->getInstanceProcAddr = &scumble::test::getInstanceProcAddr;
  return XR_SUCCESS;
}
