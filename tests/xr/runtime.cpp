// An OpenXR runtime without a headset, for tests: a head that goes where a script says, and what was shown to
// it kept as pictures. It is as strict as OpenXR allows, and writes down every mistake.
//
// SCUMBLE_TEST_XR names the script, a JSON object. What goes by frame keeps its last value.
//   record        folder for report.json, and frame-NNNN-{left,right}.ppm of each frame that was shown
//   size, angles  of an eye, pixels; of each eye, [left, right, up, down] in radians
//   poses, ipd    of the head, by frame, [x, y, z, qx, qy, qz, qw]; metres between its eyes
//   latch         metres by which the head has moved whenever the same frame is located again
//   latchTurn     radians about y by which it has turned then
//   floor         how far the head is from the origin of STAGE beyond that of LOCAL, [x, y, z]
//   flags         what is known of where the eyes are, by frame (XrViewStateFlags)
//   formats       Vulkan's numbers, in the runtime's order
//   depth         whether it takes depth buffers as well (false)
//   layers        whether swapchains may have more than one (true)
//   stage         whether there is a floor (true)
//   vulkan        whether it takes Vulkan (true)
//   headset       whether one is there (true)
//   refreshRates  frames a second that it offers; without them it has no such extension
//   period        seconds from frame to frame; default: by the refresh rate
//   comesBack     after how many xrGetSystem a headset that was lost is there again
//   hands         {"walk": [[x, y], ...], "turn": ..., "pause": [0, 1, ...], "look": ...} by frame; of each
//                 hand "point left", "grab right" and the like, and "aim left": [[x, y, z, qx, qy, qz, qw],
//                 ...]
//   synthesis     "ext" or "fb": makes frames by that extension; and motionSize, pixels of an eye's motion
//   events        [{"frame": N, "event": ...}], as frame N is waited for: hide, show, blur, focus, stop,
//   exit,
//                 loseSession, loseInstance, recentre, redrawFloor, takeOff, putOn
//   mute          true: it is asked to end, and does not answer
//   fail          {"xrCreateSession": -2, "xrLocateViews": [-2, 3]}: calls that give this result, always or
//                 from the third on
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "xr/openxr.h"

namespace {

using Json = nlohmann::json;

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

constexpr XrTime kFirstDisplay = 1'000'000'000;
constexpr XrSystemId kSystem = 7;
const auto kInstance = reinterpret_cast<XrInstance>(0x11);
const auto kSession = reinterpret_cast<XrSession>(0x22);
const auto kActionSet = reinterpret_cast<XrActionSet>(0x33);

struct Space {
  XrReferenceSpaceType type;
  std::string aim;  // of an action, what the script calls it; else it is a room
};

struct Action {
  std::string name;
  XrActionType type;
  std::vector<XrPath> hands;
};

struct Swapchain {
  VkFormat format;
  VkExtent2D extent;
  uint32_t layers;
  std::vector<VkImage> images;
  std::vector<VkDeviceMemory> memory;
  bool isDepth() const { return format == VK_FORMAT_D32_SFLOAT; }
  uint32_t pixelBytes() const { return format == VK_FORMAT_R16G16B16A16_SFLOAT ? 8 : 4; }
  // As images are acquired and released (XR_KHR_vulkan_enable2).
  VkImageLayout layout() const {
    return isDepth() ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL
                     : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  }
  uint32_t next = 0;
  int acquired = -1, released = -1;
  bool isWaited = false;
};

struct Runtime {
  Json script, report;
  std::string record;
  std::map<std::string, int> failing;
  bool hasInstance = false, askedRequirements = false;
  std::set<std::string> extensions;
  std::deque<XrEventDataBuffer> events;
  int searches = 0;
  bool isLost = false;
  // Of the session.
  bool hasSession = false, isRunning = false, wantsExit = false;
  XrSessionState state = XR_SESSION_STATE_UNKNOWN;
  VkInstance vulkan = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  uint32_t family = 0;
  std::set<Space*> spaces;
  std::set<Swapchain*> swapchains;
  float refreshRate = 72;
  // Of the hands.
  std::vector<std::string> paths;
  std::vector<std::unique_ptr<Action>> actions;
  bool hasActions = false, isAttached = false;
  int lastSync = -1, syncBefore = -1;
  // Of the frame.
  int frame = -1;  // that was waited for
  XrTime display = 0;
  bool isWaited = false, isBegun = false;
  int located = 0;
  std::array<XrView, 2> eyes{};

  Runtime() {
    if (const char* const file = std::getenv("SCUMBLE_TEST_XR")) {
      std::ifstream in(file);
      script = Json::parse(in, nullptr, false);
    }
    if (!script.is_object()) script = Json::object();
    record = script.value("record", "");
    report = {
        {"frames", Json::array()}, {"mistakes", Json::array()}, {"calls", Json::array()}, {"ended", false}};
  }
  ~Runtime() { write(); }

  void write() const {
    if (!record.empty()) std::ofstream(record + "/report.json") << report.dump(1);
  }
  XrResult mistake(const std::string& text, XrResult result) {
    report["mistakes"].push_back(text);
    write();
    return result;
  }
  // What fails by the script cannot be done rightly after it.
  bool mayFail(const char* call) const {
    const Json fail = script.value("fail", Json::object());
    return fail.contains(call);
  }
  bool offersRates() const { return script.contains("refreshRates"); }
  std::string synthesis() const { return script.value("synthesis", ""); }
  std::array<uint32_t, 2> motionSize() const {
    return script.value("motionSize", std::array<uint32_t, 2>{24, 16});
  }
};

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
#define BEGIN(call)                        \
  [[maybe_unused]] Runtime& r = runtime(); \
  if (const XrResult scripted = begun(call); scripted != XR_SUCCESS) return scripted
#define NEED(condition, text, result) \
  if (!(condition)) return r.mistake(text, result)

template <class T>
XrResult give(const std::vector<T>& all, uint32_t capacity, uint32_t* count, T* out) {
  *count = uint32_t(all.size());
  if (capacity == 0) return XR_SUCCESS;
  if (capacity < all.size()) return XR_ERROR_SIZE_INSUFFICIENT;
  std::copy(all.begin(), all.end(), out);
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

// ---- Instance

XrResult XRAPI_CALL enumerateInstanceExtensionProperties(const char*, uint32_t capacity, uint32_t* count,
                                                         XrExtensionProperties* out) {
  BEGIN("xrEnumerateInstanceExtensionProperties");
  std::vector<std::string> names;
  if (r.script.value("vulkan", true)) names.emplace_back(XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME);
  if (r.script.value("depth", false)) names.emplace_back(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME);
  if (r.offersRates()) names.emplace_back(XR_FB_DISPLAY_REFRESH_RATE_EXTENSION_NAME);
  if (r.synthesis() == "ext") names.emplace_back(kFrameSynthesisExtension);
  if (r.synthesis() == "fb") names.emplace_back(XR_FB_SPACE_WARP_EXTENSION_NAME);
  names.emplace_back(kUserPresenceExtension);
  std::vector<XrExtensionProperties> all;
  for (const std::string& name : names) {
    XrExtensionProperties& one = all.emplace_back(XrExtensionProperties{XR_TYPE_EXTENSION_PROPERTIES});
    std::strncpy(one.extensionName, name.c_str(), XR_MAX_EXTENSION_NAME_SIZE - 1);
    one.extensionVersion = 1;
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
  return give<XrViewConfigurationType>({XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO}, capacity, count, out);
}

XrResult XRAPI_CALL enumerateViewConfigurationViews(XrInstance, XrSystemId, XrViewConfigurationType,
                                                    uint32_t capacity, uint32_t* count,
                                                    XrViewConfigurationView* out) {
  BEGIN("xrEnumerateViewConfigurationViews");
  const auto size = r.script.value("size", std::array<uint32_t, 2>{64, 64});
  *count = 2;
  if (capacity == 0) return XR_SUCCESS;
  NEED(capacity >= 2, "too few views", XR_ERROR_SIZE_INSUFFICIENT);
  for (size_t eye = 0; eye < 2; ++eye) {
    NEED(out[eye].type == XR_TYPE_VIEW_CONFIGURATION_VIEW, "a view's structure has no type",
         XR_ERROR_VALIDATION_FAILURE);
    out[eye] = {out[eye].type, out[eye].next, size[0], 4096, size[1], 4096, 1, 4};
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
  // A runtime that synchronises by timelines needs the program to switch them on.
  bool hasTimelines = false;
  for (auto* next = static_cast<const VkBaseInStructure*>(info->vulkanCreateInfo->pNext); next;
       next = next->pNext)
    if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES)
      hasTimelines = reinterpret_cast<const VkPhysicalDeviceVulkan12Features*>(next)->timelineSemaphore;
  NEED(hasTimelines, "timeline semaphores are not switched on", XR_ERROR_VALIDATION_FAILURE);
  const auto create =
      reinterpret_cast<PFN_vkCreateDevice>(info->pfnGetInstanceProcAddr(r.vulkan, "vkCreateDevice"));
  *result = create(info->vulkanPhysicalDevice, info->vulkanCreateInfo, info->vulkanAllocator, device);
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
  NEED(info->primaryViewConfigurationType == XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO,
       "a session of other views", XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED);
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

// ---- Swapchains

void mustBe(VkResult result) {
  if (result != VK_SUCCESS) runtime().mistake("Vulkan: " + std::to_string(int(result)), XR_SUCCESS);
}

uint32_t memoryType(uint32_t allowed, VkMemoryPropertyFlags wanted) {
  VkPhysicalDeviceMemoryProperties properties;
  vkGetPhysicalDeviceMemoryProperties(runtime().physical, &properties);
  for (uint32_t i = 0; i < properties.memoryTypeCount; ++i)
    if ((allowed & (1u << i)) && (properties.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
  return 0;
}

void barrier(VkCommandBuffer commands, const Swapchain& of, VkImage image, VkImageLayout before,
             VkImageLayout after) {
  VkImageMemoryBarrier2 one{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
  one.srcStageMask = one.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  one.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  one.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  one.oldLayout = before, one.newLayout = after;
  one.srcQueueFamilyIndex = one.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  one.image = image;
  const auto aspect =
      VkImageAspectFlags(of.isDepth() ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT);
  one.subresourceRange = {aspect, 0, 1, 0, of.layers};
  VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  info.imageMemoryBarrierCount = 1, info.pImageMemoryBarriers = &one;
  vkCmdPipelineBarrier2(commands, &info);
}

template <class Record>
void runOnQueue(const Record& record) {
  Runtime& r = runtime();
  const VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, 0, r.family};
  VkCommandPool pool;
  mustBe(vkCreateCommandPool(r.device, &poolInfo, nullptr, &pool));
  const VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool,
                                             VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
  VkCommandBuffer commands;
  mustBe(vkAllocateCommandBuffers(r.device, &allocate, &commands));
  const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  mustBe(vkBeginCommandBuffer(commands, &begin));
  record(commands);
  mustBe(vkEndCommandBuffer(commands));
  const VkCommandBufferSubmitInfo one{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO, nullptr, commands, 0};
  VkSubmitInfo2 submit{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
  submit.commandBufferInfoCount = 1, submit.pCommandBufferInfos = &one;
  mustBe(vkQueueSubmit2(r.queue, 1, &submit, VK_NULL_HANDLE));
  mustBe(vkQueueWaitIdle(r.queue));
  vkDestroyCommandPool(r.device, pool, nullptr);
}

XrResult XRAPI_CALL enumerateSwapchainFormats(XrSession, uint32_t capacity, uint32_t* count, int64_t* out) {
  BEGIN("xrEnumerateSwapchainFormats");
  std::vector<int64_t> formats =
      r.script.value("formats", std::vector<int64_t>{VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R8G8B8A8_SRGB});
  if (r.script.value("depth", false) || !r.synthesis().empty()) formats.push_back(VK_FORMAT_D32_SFLOAT);
  if (!r.synthesis().empty()) formats.push_back(VK_FORMAT_R16G16B16A16_SFLOAT);
  return give(formats, capacity, count, out);
}

XrResult XRAPI_CALL createSwapchain(XrSession, const XrSwapchainCreateInfo* info, XrSwapchain* swapchain) {
  BEGIN("xrCreateSwapchain");
  if (info->arraySize > 1 && !r.script.value("layers", true)) return XR_ERROR_FEATURE_UNSUPPORTED;
  NEED(info->sampleCount == 1 && info->faceCount == 1 && info->mipCount == 1, "a swapchain of another kind",
       XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED);
  auto made = std::make_unique<Swapchain>();
  made->format = VkFormat(info->format);
  made->extent = {info->width, info->height};
  made->layers = info->arraySize;
  for (int i = 0; i < 3; ++i) {
    VkImageCreateInfo image{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    image.imageType = VK_IMAGE_TYPE_2D;
    image.format = made->format;
    image.extent = {info->width, info->height, 1};
    image.mipLevels = 1, image.arrayLayers = info->arraySize;
    image.samples = VK_SAMPLE_COUNT_1_BIT;
    image.usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    if (info->usageFlags & XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT)
      image.usage |= VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    if (info->usageFlags & XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT)
      image.usage |= VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    if (info->usageFlags & XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT)
      image.usage |= VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    if (info->usageFlags & XR_SWAPCHAIN_USAGE_SAMPLED_BIT) image.usage |= VK_IMAGE_USAGE_SAMPLED_BIT;
    mustBe(vkCreateImage(r.device, &image, nullptr, &made->images.emplace_back()));
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(r.device, made->images.back(), &needs);
    const VkMemoryAllocateInfo allocate{
        VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size,
        memoryType(needs.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT)};
    mustBe(vkAllocateMemory(r.device, &allocate, nullptr, &made->memory.emplace_back()));
    mustBe(vkBindImageMemory(r.device, made->images.back(), made->memory.back(), 0));
    runOnQueue([&](VkCommandBuffer commands) {
      barrier(commands, *made, made->images.back(), VK_IMAGE_LAYOUT_UNDEFINED, made->layout());
    });
  }
  r.report["swapchains"].push_back({{"format", info->format}, {"layers", info->arraySize}});
  *swapchain = reinterpret_cast<XrSwapchain>(made.get());
  r.swapchains.insert(made.release());
  return XR_SUCCESS;
}

XrResult XRAPI_CALL destroySwapchain(XrSwapchain swapchain) {
  BEGIN("xrDestroySwapchain");
  auto* const old = reinterpret_cast<Swapchain*>(swapchain);
  NEED(r.swapchains.erase(old) == 1, "a swapchain is destroyed twice", XR_ERROR_HANDLE_INVALID);
  NEED(old->acquired < 0 || r.mayFail("xrReleaseSwapchainImage"),
       "a swapchain is destroyed with an image acquired", XR_SUCCESS);
  // Frames that draw into it must be over: the validation layers tell where they are not.
  for (const VkImage image : old->images) vkDestroyImage(r.device, image, nullptr);
  for (const VkDeviceMemory memory : old->memory) vkFreeMemory(r.device, memory, nullptr);
  delete old;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL enumerateSwapchainImages(XrSwapchain swapchain, uint32_t capacity, uint32_t* count,
                                             XrSwapchainImageBaseHeader* out) {
  BEGIN("xrEnumerateSwapchainImages");
  const auto& images = reinterpret_cast<Swapchain*>(swapchain)->images;
  *count = uint32_t(images.size());
  if (capacity == 0) return XR_SUCCESS;
  auto* const all = reinterpret_cast<XrSwapchainImageVulkan2KHR*>(out);
  for (size_t i = 0; i < images.size(); ++i) {
    NEED(all[i].type == XR_TYPE_SWAPCHAIN_IMAGE_VULKAN2_KHR, "an image's structure has no type",
         XR_ERROR_VALIDATION_FAILURE);
    all[i].image = images[i];
  }
  return XR_SUCCESS;
}

XrResult XRAPI_CALL acquireSwapchainImage(XrSwapchain swapchain, const XrSwapchainImageAcquireInfo*,
                                          uint32_t* index) {
  BEGIN("xrAcquireSwapchainImage");
  auto& from = *reinterpret_cast<Swapchain*>(swapchain);
  NEED(from.acquired < 0, "an image is acquired before the last one was released",
       XR_ERROR_CALL_ORDER_INVALID);
  from.acquired = int(from.next);
  from.next = (from.next + 1) % uint32_t(from.images.size());
  from.isWaited = false;
  *index = uint32_t(from.acquired);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL waitSwapchainImage(XrSwapchain swapchain, const XrSwapchainImageWaitInfo*) {
  BEGIN("xrWaitSwapchainImage");
  auto& from = *reinterpret_cast<Swapchain*>(swapchain);
  NEED(from.acquired >= 0 && !from.isWaited, "an image is waited for that was not acquired",
       XR_ERROR_CALL_ORDER_INVALID);
  from.isWaited = true;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL releaseSwapchainImage(XrSwapchain swapchain, const XrSwapchainImageReleaseInfo*) {
  BEGIN("xrReleaseSwapchainImage");
  auto& from = *reinterpret_cast<Swapchain*>(swapchain);
  NEED(from.acquired >= 0 && from.isWaited, "an image is released that was not waited for",
       XR_ERROR_CALL_ORDER_INVALID);
  from.released = std::exchange(from.acquired, -1);
  return XR_SUCCESS;
}

// ---- Hands

XrResult XRAPI_CALL stringToPath(XrInstance, const char* text, XrPath* path) {
  BEGIN("xrStringToPath");
  const auto found = std::find(r.paths.begin(), r.paths.end(), text);
  *path = XrPath(found - r.paths.begin()) + 1;
  if (found == r.paths.end()) r.paths.emplace_back(text);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL createActionSet(XrInstance, const XrActionSetCreateInfo* info, XrActionSet* set) {
  BEGIN("xrCreateActionSet");
  NEED(info->actionSetName[0] && info->localizedActionSetName[0], "a set of actions has no name",
       XR_ERROR_NAME_INVALID);
  *set = kActionSet;
  r.hasActions = true, r.isAttached = false;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL destroyActionSet(XrActionSet) {
  BEGIN("xrDestroyActionSet");
  NEED(r.hasActions, "a set of actions is destroyed twice", XR_ERROR_HANDLE_INVALID);
  r.actions.clear();
  r.hasActions = false;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL createAction(XrActionSet, const XrActionCreateInfo* info, XrAction* action) {
  BEGIN("xrCreateAction");
  NEED(!r.isAttached, "an action for a set that is attached", XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
  const std::string name = info->actionName;
  NEED(!name.empty() &&
           name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-_./") == std::string::npos,
       "an action's name is none of OpenXR's", XR_ERROR_PATH_FORMAT_INVALID);
  for (const auto& other : r.actions)
    NEED(other->name != name, "two actions of one name", XR_ERROR_NAME_DUPLICATED);
  const std::vector<XrPath> hands(info->subactionPaths, info->subactionPaths + info->countSubactionPaths);
  for (const XrPath hand : hands)
    NEED(r.paths.at(hand - 1).starts_with("/user/hand/"), "an action of no hand", XR_ERROR_PATH_UNSUPPORTED);
  r.actions.push_back(std::make_unique<Action>(Action{name, info->actionType, hands}));
  *action = reinterpret_cast<XrAction>(r.actions.back().get());
  return XR_SUCCESS;
}

// What controllers have, by the specification (its section 6.4), as far as anybody asks for it: of one hand,
// or both.
bool isOf(const std::string& profile, const std::string& input) {
  static const std::map<std::string, std::array<std::vector<std::string>, 3>> kInputs{
      {"khr/simple_controller", {{{"select/click", "menu/click"}, {}, {}}}},
      {"oculus/touch_controller",
       {{{"squeeze/value", "trigger/value", "thumbstick", "thumbstick/click"},
         {"x/click", "y/click", "menu/click"},
         {"a/click", "b/click"}}}},
      {"valve/index_controller",
       {{{"a/click", "b/click", "squeeze/value", "trigger/click", "trigger/value", "thumbstick",
          "thumbstick/click", "trackpad"},
         {},
         {}}}},
      {"microsoft/motion_controller",
       {{{"menu/click", "squeeze/click", "trigger/value", "thumbstick", "thumbstick/click", "trackpad",
          "trackpad/click"},
         {},
         {}}}},
      {"htc/vive_controller",
       {{{"squeeze/click", "menu/click", "trigger/click", "trigger/value", "trackpad", "trackpad/click"},
         {},
         {}}}}};
  const std::string kProfiles = "/interaction_profiles/";
  const auto found =
      profile.starts_with(kProfiles) ? kInputs.find(profile.substr(kProfiles.size())) : kInputs.end();
  if (found == kInputs.end()) return false;
  const auto& [both, left, right] = found->second;
  if (input == "/user/hand/left/input/aim/pose" || input == "/user/hand/right/input/aim/pose") return true;
  for (const auto& [hand, own] : {std::pair("left", &left), std::pair("right", &right)})
    for (const auto* const inputs : {&both, own})
      for (const std::string& one : *inputs)
        if (input == "/user/hand/" + std::string(hand) + "/input/" + one) return true;
  return false;
}

XrResult XRAPI_CALL suggest(XrInstance, const XrInteractionProfileSuggestedBinding* suggested) {
  BEGIN("xrSuggestInteractionProfileBindings");
  NEED(!r.isAttached, "bindings for actions that are attached", XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
  const std::string profile = r.paths.at(suggested->interactionProfile - 1);
  NEED(suggested->countSuggestedBindings > 0, "no bindings for " + profile, XR_ERROR_VALIDATION_FAILURE);
  for (uint32_t i = 0; i < suggested->countSuggestedBindings; ++i) {
    const XrActionSuggestedBinding& one = suggested->suggestedBindings[i];
    const std::string input = r.paths.at(one.binding - 1);
    const auto* const action = reinterpret_cast<const Action*>(one.action);
    const bool isStick = input.ends_with("thumbstick") || input.ends_with("trackpad");
    const bool isPose = input.ends_with("/pose");
    NEED(isOf(profile, input) && isStick == (action->type == XR_ACTION_TYPE_VECTOR2F_INPUT) &&
             isPose == (action->type == XR_ACTION_TYPE_POSE_INPUT),
         profile + ": " + input + " is nothing for " + action->name, XR_ERROR_PATH_UNSUPPORTED);
  }
  // One that knows fewer makers.
  if (profile.find("valve") != std::string::npos) return XR_ERROR_PATH_UNSUPPORTED;
  r.report["profiles"].push_back(profile);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL attach(XrSession, const XrSessionActionSetsAttachInfo* info) {
  BEGIN("xrAttachSessionActionSets");
  NEED(!r.isAttached && info->countActionSets == 1, "actions are attached twice",
       XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
  r.isAttached = true;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL sync(XrSession, const XrActionsSyncInfo*) {
  BEGIN("xrSyncActions");
  NEED(r.isAttached, "actions are asked for that are not attached", XR_ERROR_ACTIONSET_NOT_ATTACHED);
  NEED(r.lastSync < r.frame, "hands are asked twice in a frame", XR_SUCCESS);
  if (r.state != XR_SESSION_STATE_FOCUSED) return XR_SESSION_NOT_FOCUSED;
  r.syncBefore = r.lastSync;
  r.lastSync = r.frame;
  return XR_SUCCESS;
}

// What the script calls an action, of one hand where it is of each.
std::string nameOf(const Action& action, XrPath hand) {
  const std::string path = hand ? runtime().paths.at(hand - 1) : "";
  return action.name + (hand ? " " + path.substr(path.rfind('/') + 1) : "");
}

// What the script has of that at a frame; null where it has nothing.
Json handAt(const std::string& name, int frame) {
  const Runtime& r = runtime();
  const Json hands = r.script.value("hands", Json::object());
  if (!hands.contains(name) || frame < 0) return nullptr;
  return hands[name][std::min(size_t(frame), hands[name].size() - 1)];
}

XrResult XRAPI_CALL getBoolean(XrSession, const XrActionStateGetInfo* info, XrActionStateBoolean* state) {
  BEGIN("xrGetActionStateBoolean");
  const auto& action = *reinterpret_cast<const Action*>(info->action);
  NEED(std::find(action.hands.begin(), action.hands.end(), info->subactionPath) != action.hands.end() ||
           (action.hands.empty() && !info->subactionPath),
       "an action of a hand that it is not of", XR_ERROR_PATH_UNSUPPORTED);
  const std::string name = nameOf(action, info->subactionPath);
  const Json now = handAt(name, r.lastSync), before = handAt(name, r.syncBefore);
  state->isActive = !now.is_null();
  state->currentState = state->isActive && now != 0;
  state->changedSinceLastSync = state->currentState != XrBool32(!before.is_null() && before != 0);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL getVector2f(XrSession, const XrActionStateGetInfo* info, XrActionStateVector2f* state) {
  BEGIN("xrGetActionStateVector2f");
  const Json now =
      handAt(nameOf(*reinterpret_cast<const Action*>(info->action), info->subactionPath), r.lastSync);
  state->isActive = !now.is_null();
  if (state->isActive) state->currentState = {now[0], now[1]};
  return XR_SUCCESS;
}

XrResult XRAPI_CALL createActionSpace(XrSession, const XrActionSpaceCreateInfo* info, XrSpace* space) {
  BEGIN("xrCreateActionSpace");
  const auto& action = *reinterpret_cast<const Action*>(info->action);
  NEED(action.type == XR_ACTION_TYPE_POSE_INPUT &&
           std::find(action.hands.begin(), action.hands.end(), info->subactionPath) != action.hands.end(),
       "a space of no pose", XR_ERROR_ACTION_TYPE_MISMATCH);
  auto* const made = new Space{XR_REFERENCE_SPACE_TYPE_VIEW, nameOf(action, info->subactionPath)};
  r.spaces.insert(made);
  *space = reinterpret_cast<XrSpace>(made);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL locateSpace(XrSpace space, XrSpace base, XrTime time, XrSpaceLocation* location) {
  BEGIN("xrLocateSpace");
  auto* const from = reinterpret_cast<Space*>(space);
  auto* const room = reinterpret_cast<Space*>(base);
  NEED(r.spaces.count(from) == 1 && r.spaces.count(room) == 1 && !from->aim.empty() && room->aim.empty(),
       "a hand in no room", XR_ERROR_HANDLE_INVALID);
  NEED(time == r.display, "a hand at another time than the frame's", XR_ERROR_TIME_INVALID);
  NEED(location->type == XR_TYPE_SPACE_LOCATION, "a location's structure has no type",
       XR_ERROR_VALIDATION_FAILURE);
  const Json at = handAt(from->aim, r.frame);
  location->locationFlags = at.is_null() ? 0 : 15;
  if (at.is_null()) return XR_SUCCESS;
  auto pose = at.get<std::array<float, 7>>();
  const auto floor = r.script.value("floor", std::array<float, 3>{0, 0, 0});
  if (room->type == XR_REFERENCE_SPACE_TYPE_STAGE)
    for (size_t i = 0; i < 3; ++i) pose[i] += floor[i];
  location->pose = {{pose[3], pose[4], pose[5], pose[6]}, {pose[0], pose[1], pose[2]}};
  return XR_SUCCESS;
}

// ---- Frames

void happen(const std::string& event) {
  Runtime& r = runtime();
  if (event == "hide") goTo(XR_SESSION_STATE_VISIBLE), goTo(XR_SESSION_STATE_SYNCHRONIZED);
  if (event == "show") goTo(XR_SESSION_STATE_VISIBLE), goTo(XR_SESSION_STATE_FOCUSED);
  if (event == "blur") goTo(XR_SESSION_STATE_VISIBLE);
  if (event == "focus") goTo(XR_SESSION_STATE_FOCUSED);
  if (event == "exit") r.wantsExit = true;
  if (event == "stop" || event == "exit")
    goTo(XR_SESSION_STATE_VISIBLE), goTo(XR_SESSION_STATE_SYNCHRONIZED), goTo(XR_SESSION_STATE_STOPPING);
  if (event == "loseSession") r.isLost = true, goTo(XR_SESSION_STATE_LOSS_PENDING);
  if (event == "loseInstance") {
    const XrEventDataInstanceLossPending lost{XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING, nullptr, 0};
    post(&lost, sizeof lost);
  }
  if (event == "recentre" || event == "redrawFloor") {
    XrEventDataReferenceSpaceChangePending changed{XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING};
    changed.session = kSession;
    changed.referenceSpaceType =
        event == "recentre" ? XR_REFERENCE_SPACE_TYPE_LOCAL : XR_REFERENCE_SPACE_TYPE_STAGE;
    // It holds from the frame after the next one on.
    changed.changeTime = r.display + 2 * XrDuration(1e9 / double(r.refreshRate));
    post(&changed, sizeof changed);
  }
  if (event == "takeOff" || event == "putOn") {
    const XrEventDataUserPresenceChanged changed{kTypeUserPresenceChanged, nullptr, kSession,
                                                 XrBool32(event == "putOn")};
    post(&changed, sizeof changed);
  }
}

XrResult XRAPI_CALL waitFrame(XrSession, const XrFrameWaitInfo*, XrFrameState* state) {
  BEGIN("xrWaitFrame");
  NEED(r.isRunning, "a frame of a session that does not run", XR_ERROR_SESSION_NOT_RUNNING);
  NEED(!r.isWaited, "a frame is waited for twice", XR_ERROR_CALL_ORDER_INVALID);
  ++r.frame;
  const auto period = XrDuration(1e9 * r.script.value("period", 1 / double(r.refreshRate)));
  r.display = kFirstDisplay + r.frame * period;
  if (r.script.contains("events"))
    for (const Json& event : r.script["events"])
      if (event["frame"] == r.frame) happen(event["event"]);
  r.isWaited = true;
  r.located = 0;
  state->predictedDisplayTime = r.display;
  state->predictedDisplayPeriod = period;
  state->shouldRender =
      r.state == XR_SESSION_STATE_VISIBLE || r.state == XR_SESSION_STATE_FOCUSED ? XR_TRUE : XR_FALSE;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL beginFrame(XrSession, const XrFrameBeginInfo*) {
  BEGIN("xrBeginFrame");
  NEED(r.isWaited, "a frame is begun that was not waited for", XR_ERROR_CALL_ORDER_INVALID);
  NEED(!r.isBegun, "a frame is begun within another", XR_ERROR_CALL_ORDER_INVALID);
  r.isWaited = false, r.isBegun = true;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL locateViews(XrSession, const XrViewLocateInfo* info, XrViewState* state,
                                uint32_t capacity, uint32_t* count, XrView* out) {
  BEGIN("xrLocateViews");
  NEED(r.spaces.count(reinterpret_cast<Space*>(info->space)) == 1, "eyes in no space",
       XR_ERROR_HANDLE_INVALID);
  NEED(info->displayTime == r.display, "eyes at another time than the frame's", XR_ERROR_TIME_INVALID);
  *count = 2;
  if (capacity == 0) return XR_SUCCESS;
  const auto flags = r.script.value("flags", std::vector<XrViewStateFlags>{15});
  state->viewStateFlags = flags[std::min(size_t(r.frame), flags.size() - 1)];
  std::array<float, 7> head{0, 0, 0, 0, 0, 0, 1};
  if (const Json poses = r.script.value("poses", Json::array()); !poses.empty())
    head = poses[std::min(size_t(r.frame), poses.size() - 1)].get<std::array<float, 7>>();
  const auto latch = r.script.value("latch", std::array<float, 3>{0, 0, 0});
  const bool isOnFloor = reinterpret_cast<Space*>(info->space)->type == XR_REFERENCE_SPACE_TYPE_STAGE;
  const auto floor = r.script.value("floor", std::array<float, 3>{0, 0, 0});
  for (size_t i = 0; i < 3; ++i) head[i] += float(r.located) * latch[i] + (isOnFloor ? floor[i] : 0);
  if (const float turn = 0.5f * float(r.located) * r.script.value("latchTurn", 0.0f); turn != 0) {
    // About y, after what it is.
    const float c = std::cos(turn), t = std::sin(turn);
    head = {head[0],
            head[1],
            head[2],
            c * head[3] + t * head[5],
            c * head[4] + t * head[6],
            c * head[5] - t * head[3],
            c * head[6] - t * head[4]};
  }
  ++r.located;
  // The head's own x axis, for its eyes.
  const float x = head[3], y = head[4], z = head[5], w = head[6];
  const std::array<float, 3> side{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)};
  const float half = 0.5f * r.script.value("ipd", 0.064f);
  for (size_t eye = 0; eye < 2; ++eye) {
    NEED(out[eye].type == XR_TYPE_VIEW, "a view's structure has no type", XR_ERROR_VALIDATION_FAILURE);
    const float along = eye == 0 ? -half : half;
    XrView& view = r.eyes[eye];
    view = {XR_TYPE_VIEW};
    view.pose = {{x, y, z, w},
                 {head[0] + along * side[0], head[1] + along * side[1], head[2] + along * side[2]}};
    const auto angles = r.script.contains("angles") ? r.script["angles"][eye].get<std::array<float, 4>>()
                                                    : std::array<float, 4>{-0.5f, 0.5f, 0.5f, -0.5f};
    view.fov = {angles[0], angles[1], angles[2], angles[3]};
    out[eye].pose = view.pose, out[eye].fov = view.fov;
  }
  return XR_SUCCESS;
}

// As they are stored.
std::vector<uint8_t> bytesOf(const Swapchain& from, uint32_t layer, const XrRect2Di& rect) {
  Runtime& r = runtime();
  const auto width = uint32_t(rect.extent.width), height = uint32_t(rect.extent.height);
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = VkDeviceSize(width) * height * from.pixelBytes();
  info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  VkBuffer buffer;
  mustBe(vkCreateBuffer(r.device, &info, nullptr, &buffer));
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(r.device, buffer, &needs);
  const VkMemoryAllocateInfo allocate{
      VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size,
      memoryType(needs.memoryTypeBits,
                 VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT)};
  VkDeviceMemory memory;
  mustBe(vkAllocateMemory(r.device, &allocate, nullptr, &memory));
  mustBe(vkBindBufferMemory(r.device, buffer, memory, 0));
  const VkImage image = from.images[size_t(from.released)];
  runOnQueue([&](VkCommandBuffer commands) {
    barrier(commands, from, image, from.layout(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    VkBufferImageCopy copy{};
    copy.imageSubresource = {
        VkImageAspectFlags(from.isDepth() ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT), 0, layer,
        1};
    copy.imageOffset = {rect.offset.x, rect.offset.y, 0};
    copy.imageExtent = {width, height, 1};
    vkCmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer, 1, &copy);
    barrier(commands, from, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, from.layout());
  });
  void* mapped = nullptr;
  mustBe(vkMapMemory(r.device, memory, 0, VK_WHOLE_SIZE, 0, &mapped));
  const auto* const start = static_cast<const uint8_t*>(mapped);
  std::vector<uint8_t> bytes(start, start + info.size);
  vkFreeMemory(r.device, memory, nullptr);
  vkDestroyBuffer(r.device, buffer, nullptr);
  return bytes;
}

void savePicture(const Swapchain& from, uint32_t layer, const XrRect2Di& rect, const std::string& file) {
  const bool isBgra = from.format == VK_FORMAT_B8G8R8A8_SRGB;
  if (!isBgra && from.format != VK_FORMAT_R8G8B8A8_SRGB) return;
  const std::vector<uint8_t> bytes = bytesOf(from, layer, rect);
  std::ofstream out(file, std::ios::binary);
  out << "P6\n" << rect.extent.width << " " << rect.extent.height << "\n255\n";
  for (size_t i = 0; i < bytes.size(); i += 4)
    for (const size_t channel : {isBgra ? 2 : 0, 1, isBgra ? 0 : 2}) out.put(char(bytes[i + channel]));
}

// A picture in the room.
XrResult lookAtRay(const XrCompositionLayerQuad& quad, Json& frame) {
  Runtime& r = runtime();
  const XrVector3f& at = quad.pose.position;
  const XrQuaternionf& q = quad.pose.orientation;
  NEED(std::abs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1) < 1e-3f, "a quad's turn is none",
       XR_ERROR_POSE_INVALID);
  NEED(quad.layerFlags == (XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT |
                           XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT),
       "a ray that covers all", XR_ERROR_LAYER_INVALID);
  // Along it, and what it faces.
  const std::array<float, 3> along{1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y + q.w * q.z),
                                   2 * (q.x * q.z - q.w * q.y)},
      facing{2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x), 1 - 2 * (q.x * q.x + q.y * q.y)};
  frame["rays"].push_back({{"at", {at.x, at.y, at.z}},
                           {"size", {quad.size.width, quad.size.height}},
                           {"along", along},
                           {"facing", facing}});
  return XR_SUCCESS;
}

// A picture that goes with the head.
XrResult lookAtQuad(const XrCompositionLayerQuad& quad, Json& frame) {
  Runtime& r = runtime();
  auto* const from = reinterpret_cast<Swapchain*>(quad.subImage.swapchain);
  auto* const space = reinterpret_cast<Space*>(quad.space);
  NEED(r.swapchains.count(from) == 1 && from->released >= 0 && from->acquired < 0,
       "a quad of an image that was not released", XR_ERROR_LAYER_INVALID);
  NEED(r.spaces.count(space) == 1 && space->aim.empty(), "a quad in no space", XR_ERROR_HANDLE_INVALID);
  if (space->type != XR_REFERENCE_SPACE_TYPE_VIEW) return lookAtRay(quad, frame);
  NEED(quad.layerFlags == XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT, "a quad that covers all",
       XR_ERROR_LAYER_INVALID);
  Json one{{"size", quad.size.width}, {"distance", -quad.pose.position.z}};
  if (from->format == VK_FORMAT_R8G8B8A8_SRGB) {
    const std::vector<uint8_t> bytes = bytesOf(*from, 0, quad.subImage.imageRect);
    const auto width = size_t(quad.subImage.imageRect.extent.width);
    // From the middle to the right.
    for (size_t x = width / 2; x < width; ++x) one["alpha"].push_back(bytes[4 * (width / 2 * width + x) + 3]);
    one["light"] = *std::max_element(bytes.begin(), bytes.begin() + 3);
  }
  frame["quads"].push_back(one);
  return XR_SUCCESS;
}

// How far away what a view shows is.
XrResult lookAtDepth(const XrCompositionLayerProjectionView& view,
                     const XrCompositionLayerDepthInfoKHR& depth, const std::string& file, Json& eye) {
  Runtime& r = runtime();
  NEED(r.extensions.count(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME) == 1, "depth without its extension",
       XR_ERROR_VALIDATION_FAILURE);
  auto* const from = reinterpret_cast<Swapchain*>(depth.subImage.swapchain);
  NEED(r.swapchains.count(from) == 1 && from->isDepth() && from->released >= 0 && from->acquired < 0,
       "depth of an image that was not released", XR_ERROR_LAYER_INVALID);
  const XrRect2Di &rect = depth.subImage.imageRect, &seen = view.subImage.imageRect;
  NEED(rect.offset.x == seen.offset.x && rect.offset.y == seen.offset.y &&
           rect.extent.width == seen.extent.width && rect.extent.height == seen.extent.height &&
           uint32_t(rect.extent.width) <= from->extent.width &&
           uint32_t(rect.extent.height) <= from->extent.height &&
           depth.subImage.imageArrayIndex < from->layers,
       "depth of another rectangle than the view's", XR_ERROR_SWAPCHAIN_RECT_INVALID);
  NEED(depth.minDepth >= 0 && depth.maxDepth <= 1 && depth.minDepth < depth.maxDepth && depth.nearZ > 0 &&
           depth.farZ > 0 && depth.nearZ != depth.farZ,
       "depths that make no sense", XR_ERROR_VALIDATION_FAILURE);
  // Metres: what lies at minDepth is nearZ away. JSON knows no infinity.
  eye["depth"] = {{"nearZ", std::isinf(depth.nearZ) ? -1 : depth.nearZ}, {"farZ", depth.farZ}};
  if (r.record.empty()) return XR_SUCCESS;
  const std::vector<uint8_t> bytes = bytesOf(*from, depth.subImage.imageArrayIndex, rect);
  std::ofstream out(r.record + "/" + file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  return XR_SUCCESS;
}

// What frame synthesis takes, of either extension.
template <class Info>
XrResult lookAtMotion(const Info& info, const std::string& file, Json& eye) {
  Runtime& r = runtime();
  const auto& parts = {&info.motionVectorSubImage, &info.depthSubImage};
  for (const XrSwapchainSubImage* const part : parts) {
    auto* const from = reinterpret_cast<Swapchain*>(part->swapchain);
    NEED(r.swapchains.count(from) == 1 && from->released >= 0 && from->acquired < 0,
         "motion of an image that was not released", XR_ERROR_LAYER_INVALID);
    NEED(from->isDepth() == (part == &info.depthSubImage) &&
             (from->isDepth() || from->format == VK_FORMAT_R16G16B16A16_SFLOAT),
         "motion in another format", XR_ERROR_LAYER_INVALID);
    const auto size = r.motionSize();
    NEED(part->imageRect.offset.x == 0 && part->imageRect.offset.y == 0 &&
             uint32_t(part->imageRect.extent.width) == size[0] &&
             uint32_t(part->imageRect.extent.height) == size[1] && part->imageArrayIndex < from->layers,
         "motion of another size than was recommended", XR_ERROR_SWAPCHAIN_RECT_INVALID);
    if (r.record.empty()) continue;
    const std::vector<uint8_t> bytes = bytesOf(*from, part->imageArrayIndex, part->imageRect);
    std::ofstream out(r.record + "/" + file + (from->isDepth() ? ".motion-depth" : ".motion"),
                      std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  }
  NEED(info.nearZ != info.farZ && info.minDepth == 0 && info.maxDepth == 1, "depths that make no sense",
       XR_ERROR_VALIDATION_FAILURE);
  const XrPosef& room = info.appSpaceDeltaPose;
  eye["motion"] = {{"flags", info.layerFlags},
                   {"farZ", info.farZ},
                   {"room",
                    {room.position.x, room.position.y, room.position.z, room.orientation.x,
                     room.orientation.y, room.orientation.z, room.orientation.w}}};
  return XR_SUCCESS;
}

// What is chained behind a view.
XrResult lookAtChain(const XrCompositionLayerProjectionView& view, const std::string& name, Json& eye) {
  Runtime& r = runtime();
  for (auto* next = static_cast<const XrBaseInStructure*>(view.next); next; next = next->next) {
    XrResult result = XR_SUCCESS;
    if (next->type == XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR) {
      result = lookAtDepth(view, *reinterpret_cast<const XrCompositionLayerDepthInfoKHR*>(next),
                           name + ".depth", eye);
    } else if (next->type == kTypeFrameSynthesisInfo && r.extensions.count(kFrameSynthesisExtension)) {
      const auto& info = *reinterpret_cast<const XrFrameSynthesisInfo*>(next);
      NEED(info.motionVectorScale.x == 1 && info.motionVectorScale.y == 1 && info.motionVectorScale.z == 1 &&
               info.motionVectorOffset.x == 0,
           "motion that is scaled", XR_ERROR_VALIDATION_FAILURE);
      result = lookAtMotion(info, name, eye);
    } else if (next->type == XR_TYPE_COMPOSITION_LAYER_SPACE_WARP_INFO_FB &&
               r.extensions.count(XR_FB_SPACE_WARP_EXTENSION_NAME)) {
      result = lookAtMotion(*reinterpret_cast<const XrCompositionLayerSpaceWarpInfoFB*>(next), name, eye);
    } else {
      return r.mistake("a view with something unknown", XR_ERROR_VALIDATION_FAILURE);
    }
    if (result != XR_SUCCESS) return result;
  }
  return XR_SUCCESS;
}

XrResult XRAPI_CALL endFrame(XrSession, const XrFrameEndInfo* info) {
  BEGIN("xrEndFrame");
  NEED(r.isBegun, "a frame is ended that was not begun", XR_ERROR_CALL_ORDER_INVALID);
  NEED(info->displayTime == r.display, "a frame ends at another time", XR_ERROR_TIME_INVALID);
  NEED(info->environmentBlendMode == XR_ENVIRONMENT_BLEND_MODE_OPAQUE, "a blend mode that is not offered",
       XR_ERROR_ENVIRONMENT_BLEND_MODE_UNSUPPORTED);
  r.isBegun = false;
  Json frame{
      {"frame", r.frame}, {"display", r.display}, {"layers", info->layerCount}, {"eyes", Json::array()}};
  for (uint32_t l = 0; l < info->layerCount; ++l) {
    if (info->layers[l]->type == XR_TYPE_COMPOSITION_LAYER_QUAD) {
      const XrResult result =
          lookAtQuad(*reinterpret_cast<const XrCompositionLayerQuad*>(info->layers[l]), frame);
      if (result != XR_SUCCESS) return result;
      continue;
    }
    const auto* const layer = reinterpret_cast<const XrCompositionLayerProjection*>(info->layers[l]);
    NEED(layer->type == XR_TYPE_COMPOSITION_LAYER_PROJECTION && layer->viewCount == 2,
         "a layer of another kind", XR_ERROR_LAYER_INVALID);
    NEED(r.spaces.count(reinterpret_cast<Space*>(layer->space)) == 1, "a layer in no space",
         XR_ERROR_HANDLE_INVALID);
    NEED(r.located > 0, "a layer of eyes that were not located", XR_ERROR_POSE_INVALID);
    for (uint32_t eye = 0; eye < 2; ++eye) {
      const XrCompositionLayerProjectionView& view = layer->views[eye];
      auto* const from = reinterpret_cast<Swapchain*>(view.subImage.swapchain);
      NEED(view.type == XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW && r.swapchains.count(from) == 1,
           "a view of no swapchain", XR_ERROR_HANDLE_INVALID);
      NEED(from->released >= 0 && from->acquired < 0, "a view of an image that was not released",
           XR_ERROR_LAYER_INVALID);
      const XrRect2Di& rect = view.subImage.imageRect;
      NEED(rect.offset.x >= 0 && rect.offset.y >= 0 && rect.extent.width > 0 && rect.extent.height > 0 &&
               uint32_t(rect.offset.x + rect.extent.width) <= from->extent.width &&
               uint32_t(rect.offset.y + rect.extent.height) <= from->extent.height &&
               view.subImage.imageArrayIndex < from->layers,
           "a view reaches out of its image", XR_ERROR_SWAPCHAIN_RECT_INVALID);
      // What is shown was drawn from where the runtime has last said that the eyes are.
      const XrVector3f &a = view.pose.position, &b = r.eyes[eye].pose.position;
      NEED(std::hypot(a.x - b.x, a.y - b.y, a.z - b.z) < 1e-5f, "a view is from elsewhere than its eye",
           XR_SUCCESS);
      const XrQuaternionf &p = view.pose.orientation, &q = r.eyes[eye].pose.orientation;
      NEED(std::abs(p.x * q.x + p.y * q.y + p.z * q.z + p.w * q.w) > 1 - 1e-6f,
           "a view is turned otherwise than its eye", XR_SUCCESS);
      const XrFovf &seen = view.fov, &told = r.eyes[eye].fov;
      NEED(seen.angleLeft == told.angleLeft && seen.angleRight == told.angleRight &&
               seen.angleUp == told.angleUp && seen.angleDown == told.angleDown,
           "a view of other angles than its eye's", XR_SUCCESS);
      char name[64];
      std::snprintf(name, sizeof name, "frame-%04d-%s.ppm", r.frame, eye == 0 ? "left" : "right");
      if (!r.record.empty()) savePicture(*from, view.subImage.imageArrayIndex, rect, r.record + "/" + name);
      frame["eyes"].push_back(
          {{"place", {a.x, a.y, a.z}}, {"size", {rect.extent.width, rect.extent.height}}, {"picture", name}});
      const XrResult result = lookAtChain(view, name, frame["eyes"].back());
      if (result != XR_SUCCESS) return result;
    }
  }
  r.report["frames"].push_back(frame);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL getInstanceProcAddr(XrInstance instance, const char* name, PFN_xrVoidFunction* function) {
#define ENTRY(name, function) \
  { "xr" #name, reinterpret_cast<PFN_xrVoidFunction>(&function) }
  static const std::map<std::string, PFN_xrVoidFunction> kAll{
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
      ENTRY(EnumerateSwapchainFormats, enumerateSwapchainFormats),
      ENTRY(CreateSwapchain, createSwapchain),
      ENTRY(DestroySwapchain, destroySwapchain),
      ENTRY(EnumerateSwapchainImages, enumerateSwapchainImages),
      ENTRY(AcquireSwapchainImage, acquireSwapchainImage),
      ENTRY(WaitSwapchainImage, waitSwapchainImage),
      ENTRY(ReleaseSwapchainImage, releaseSwapchainImage),
      ENTRY(WaitFrame, waitFrame),
      ENTRY(BeginFrame, beginFrame),
      ENTRY(LocateViews, locateViews),
      ENTRY(LocateSpace, locateSpace),
      ENTRY(EndFrame, endFrame),
      ENTRY(StringToPath, stringToPath),
      ENTRY(CreateActionSet, createActionSet),
      ENTRY(DestroyActionSet, destroyActionSet),
      ENTRY(CreateAction, createAction),
      ENTRY(CreateActionSpace, createActionSpace),
      ENTRY(SuggestInteractionProfileBindings, suggest),
      ENTRY(AttachSessionActionSets, attach),
      ENTRY(SyncActions, sync),
      ENTRY(GetActionStateBoolean, getBoolean),
      ENTRY(GetActionStateVector2f, getVector2f),
  };
  (void)instance;
  const auto found = kAll.find(name);
  const bool isRate = std::strstr(name, "RefreshRate");
  *function = found == kAll.end() || (isRate && !runtime().offersRates()) ? nullptr : found->second;
  return *function ? XR_SUCCESS : XR_ERROR_FUNCTION_UNSUPPORTED;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) XrResult xrNegotiateLoaderRuntimeInterface(
    const NegotiateLoaderInfo* info, NegotiateRuntimeRequest* request) {
  if (info->minInterfaceVersion > 1 || info->maxInterfaceVersion < 1) return XR_ERROR_INITIALIZATION_FAILED;
  request->runtimeInterfaceVersion = 1;
  request->runtimeApiVersion = XR_MAKE_VERSION(1, 0, 20);
  request->getInstanceProcAddr = &getInstanceProcAddr;
  return XR_SUCCESS;
}
