#include "gpu/device.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "gpu/cache_file.h"
#include "gpu/pipeline.h"
#include "gpu/view_probe.h"
#include "scumble/vulkan.h"

namespace scumble::gpu {

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

// Calls visit(feature, name) for every feature that scumble requires.
template <class Visit>
void forEachRequired(VulkanFeatures& f, Visit visit) {
  visit(f.dynamicRendering.dynamicRendering, "dynamicRendering");
  visit(f.synchronization2.synchronization2, "synchronization2");
  visit(f.maintenance4.maintenance4, "maintenance4");
  visit(f.scalarBlockLayout.scalarBlockLayout, "scalarBlockLayout");
  visit(f.bufferDeviceAddress.bufferDeviceAddress, "bufferDeviceAddress");
  visit(f.multiview.multiview, "multiview");
  visit(f.core.features.fragmentStoresAndAtomics, "fragmentStoresAndAtomics");
  visit(f.core.features.independentBlend, "independentBlend");
  visit(f.core.features.multiDrawIndirect, "multiDrawIndirect");
  visit(f.core.features.drawIndirectFirstInstance, "drawIndirectFirstInstance");
}

// What image passes use of subgroups, whichever way they run.
bool hasSubgroups(VkPhysicalDevice physical) {
  VkPhysicalDeviceSubgroupProperties subgroups{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES};
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &subgroups};
  vkGetPhysicalDeviceProperties2(physical, &properties);
  constexpr VkSubgroupFeatureFlags kNeeded =
      VK_SUBGROUP_FEATURE_ARITHMETIC_BIT | VK_SUBGROUP_FEATURE_QUAD_BIT;
  constexpr VkShaderStageFlags kStages = VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT;
  return (subgroups.supportedOperations & kNeeded) == kNeeded &&
         (subgroups.supportedStages & kStages) == kStages;
}

// What frames ask of images, beyond what Vulkan promises for these formats. Empty where all is there.
std::string missingOfFormats(VkPhysicalDevice physical) {
  constexpr VkFormatFeatureFlags2 kDrawnAndRead =
      VK_FORMAT_FEATURE_2_COLOR_ATTACHMENT_BIT | VK_FORMAT_FEATURE_2_SAMPLED_IMAGE_BIT;
  constexpr VkFormatFeatureFlags2 kFiltered = VK_FORMAT_FEATURE_2_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
  const struct {
    VkFormat format;
    VkFormatFeatureFlags2 features;
    const char* lacking;
  } needs[] = {
      {VK_FORMAT_D32_SFLOAT,
       VK_FORMAT_FEATURE_2_DEPTH_STENCIL_ATTACHMENT_BIT | VK_FORMAT_FEATURE_2_SAMPLED_IMAGE_BIT |
           VK_FORMAT_FEATURE_2_SAMPLED_IMAGE_DEPTH_COMPARISON_BIT,
       "comparison with 32 bit depth"},
      {VK_FORMAT_R16G16B16A16_SFLOAT, kDrawnAndRead | kFiltered | VK_FORMAT_FEATURE_2_STORAGE_IMAGE_BIT,
       "half floats as images of every kind"},
      {VK_FORMAT_R32G32B32A32_SFLOAT, kDrawnAndRead, "32 bit floats as colours"},
      {VK_FORMAT_R32G32B32A32_UINT, kDrawnAndRead, "32 bit integers as colours"},
      {VK_FORMAT_R8G8B8A8_SRGB, kDrawnAndRead | kFiltered, "sRGB as colours"},
      {VK_FORMAT_R16G16_SNORM, VK_FORMAT_FEATURE_2_VERTEX_BUFFER_BIT, "16 bit normals"},
  };
  for (const auto& need : needs) {
    VkFormatProperties3 has{VK_STRUCTURE_TYPE_FORMAT_PROPERTIES_3};
    VkFormatProperties2 properties{VK_STRUCTURE_TYPE_FORMAT_PROPERTIES_2, &has, {}};
    vkGetPhysicalDeviceFormatProperties2(physical, need.format, &properties);
    const VkFormatFeatureFlags2 there = has.optimalTilingFeatures | has.bufferFeatures;
    if ((there & need.features) != need.features) return need.lacking;
  }
  return "";
}

// Targets that one step draws into: the facts pass has most.
constexpr uint32_t kMostTargets = 8;

bool hasGraphicsQueue(VkPhysicalDevice physical, uint32_t* family) {
  uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  constexpr VkQueueFlags kNeeded = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  for (uint32_t i = 0; i < count; ++i)
    if ((families[i].queueFlags & kNeeded) == kNeeded) {
      *family = i;
      return true;
    }
  return false;
}

DeviceInfo describe(VkPhysicalDevice physical) {
  VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver};
  vkGetPhysicalDeviceProperties2(physical, &properties);
  DeviceInfo info;
  info.name = properties.properties.deviceName;
  info.driver = std::string(driver.driverName) + " " + driver.driverInfo;
  info.apiVersion = properties.properties.apiVersion;
  info.isCpu = properties.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
  info.discrete = properties.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;

  uint32_t family;
  if (info.apiVersion < VK_API_VERSION_1_3) {
    info.unusableBecause = "it offers less than Vulkan 1.3";
  } else if (!hasGraphicsQueue(physical, &family)) {
    info.unusableBecause = "it has no queue for graphics and compute";
  } else {
    VulkanFeatures features;
    vkGetPhysicalDeviceFeatures2(physical, &features.core);
    forEachRequired(features, [&](VkBool32 present, const char* name) {
      if (!present && info.unusableBecause.empty()) info.unusableBecause = std::string("it lacks ") + name;
    });
    if (info.unusableBecause.empty() && !hasSubgroups(physical))
      info.unusableBecause = "it lacks arithmetic and quads of subgroups";
    if (info.unusableBecause.empty())
      if (const std::string missing = missingOfFormats(physical); !missing.empty())
        info.unusableBecause = "it lacks " + missing;
    const VkPhysicalDeviceLimits& limits = properties.properties.limits;
    if (info.unusableBecause.empty() &&
        std::min(limits.maxColorAttachments, limits.maxFragmentOutputAttachments) < kMostTargets)
      info.unusableBecause = "it draws into fewer than " + std::to_string(kMostTargets) + " targets at once";
  }
  return info;
}

bool hasInstanceExtension(const char* layer, const char* name) {
  uint32_t count = 0;
  vkEnumerateInstanceExtensionProperties(layer, &count, nullptr);
  std::vector<VkExtensionProperties> available(count);
  vkEnumerateInstanceExtensionProperties(layer, &count, available.data());
  return std::any_of(available.begin(), available.end(), [&](const VkExtensionProperties& extension) {
    return !strcmp(extension.extensionName, name);
  });
}

Result<VkInstance> createInstance(bool validation, const VulkanWishes& wishes = {}) {
  std::vector<const char*> layers, extensions;
  for (const std::string& name : wishes.instanceExtensions) extensions.push_back(name.c_str());
  const VkValidationFeatureEnableEXT enabled[] = {
      VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
  if (validation) {
    uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> available(count);
    vkEnumerateInstanceLayerProperties(&count, available.data());
    if (std::none_of(available.begin(), available.end(), [](const VkLayerProperties& layer) {
          return !strcmp(layer.layerName, kValidationLayer);
        }))
      return Error{ErrorKind::noUsableGpu,
                   "",
                   0,
                   "",
                   "the Vulkan validation layer is not installed",
                   "install the package vulkan-validationlayers"};
    layers.push_back(kValidationLayer);
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = enabled;
  }
  // Captures and messages call things by our names.
  if (hasInstanceExtension(validation ? kValidationLayer : nullptr, VK_EXT_DEBUG_UTILS_EXTENSION_NAME) ||
      hasInstanceExtension(nullptr, VK_EXT_DEBUG_UTILS_EXTENSION_NAME))
    if (std::none_of(extensions.begin(), extensions.end(),
                     [](const char* name) { return !strcmp(name, VK_EXT_DEBUG_UTILS_EXTENSION_NAME); }))
      extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.pApplicationName = "scumble";
  application.apiVersion = VK_API_VERSION_1_3;
  VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  info.pNext = validation ? &features : nullptr;
  info.pApplicationInfo = &application;
  info.enabledLayerCount = uint32_t(layers.size());
  info.ppEnabledLayerNames = layers.data();
  info.enabledExtensionCount = uint32_t(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  if (wishes.createInstance) return wishes.createInstance(info);
  VkInstance instance;
  const VkResult result = vkCreateInstance(&info, nullptr, &instance);
  if (result != VK_SUCCESS)
    return Error{ErrorKind::noUsableGpu,
                 "",
                 0,
                 "",
                 std::string("Vulkan cannot start (") + resultName(result) + ")",
                 "install a Vulkan 1.3 driver, e.g. the package mesa-vulkan-drivers"};
  return instance;
}

std::vector<VkPhysicalDevice> physicalDevices(VkInstance instance) {
  uint32_t count = 0;
  vkEnumeratePhysicalDevices(instance, &count, nullptr);
  std::vector<VkPhysicalDevice> devices(count);
  vkEnumeratePhysicalDevices(instance, &count, devices.data());
  devices.resize(count);
  return devices;
}

bool containsIgnoringCase(const std::string& text, const std::string& part) {
  return std::search(text.begin(), text.end(), part.begin(), part.end(), [](char a, char b) {
           return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
         }) != text.end();
}

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                         VkDebugUtilsMessageTypeFlagsEXT,
                                         const VkDebugUtilsMessengerCallbackDataEXT* data, void* device) {
  static_cast<Device*>(device)->addValidationMessage(data->pMessage);
  return VK_FALSE;
}

}  // namespace

const char* resultName(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "there is not enough memory";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "there is not enough memory on the device";
    case VK_ERROR_DEVICE_LOST:
      return "the device was lost";
    case VK_ERROR_INITIALIZATION_FAILED:
      return "initialisation failed";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "no driver was found";
    case VK_ERROR_FEATURE_NOT_PRESENT:
      return "a feature is missing";
    case VK_ERROR_FORMAT_NOT_SUPPORTED:
      return "a format is not supported";
    default:
      return "the driver gave an unexpected result";
  }
}

std::string VulkanError::message() const {
  // What was called, without its arguments.
  return std::string(resultName(result)) + " (" + std::string(call, std::strcspn(call, "(")) + ", " +
         std::to_string(int(result)) + ")";
}

Result<std::vector<DeviceInfo>> listDevices() {
  Result<VkInstance> instance = createInstance(false);
  if (!instance) return instance.error();
  std::vector<DeviceInfo> infos;
  for (VkPhysicalDevice physical : physicalDevices(*instance)) infos.push_back(describe(physical));
  vkDestroyInstance(*instance, nullptr);
  return infos;
}

Result<size_t> chooseDevice(const std::vector<DeviceInfo>& devices, const std::string& choice) {
  const auto fail = [](const std::string& problem) {
    return Error{ErrorKind::noUsableGpu,
                 "",
                 0,
                 "",
                 problem,
                 "see `scumble devices`; the package mesa-vulkan-drivers has a driver that runs on any CPU"};
  };
  const bool isNumber =
      !choice.empty() && choice.size() < 6 &&
      std::all_of(choice.begin(), choice.end(), [](char c) { return c >= '0' && c <= '9'; });
  std::optional<size_t> best;
  for (size_t i = 0; i < devices.size(); ++i) {
    const DeviceInfo& device = devices[i];
    const bool wanted = choice.empty()    ? true
                        : isNumber        ? size_t(std::stoi(choice)) == i
                        : choice == "cpu" ? device.isCpu
                        : choice == "gpu" ? !device.isCpu
                                          : containsIgnoringCase(device.name, choice);
    if (!wanted) continue;
    if (!device.unusableBecause.empty()) {
      if (!choice.empty() && choice != "gpu")
        return fail("the device '" + device.name + "' cannot be used: " + device.unusableBecause);
      continue;
    }
    const auto rank = [&](const DeviceInfo& d) { return d.discrete ? 2 : d.isCpu ? 0 : 1; };
    if (!best || rank(device) > rank(devices[*best])) best = i;
  }
  if (best) return *best;
  return fail(choice.empty()    ? "no usable Vulkan 1.3 device was found"
              : choice == "gpu" ? "no usable Vulkan 1.3 device but this machine's processor was found"
                                : "no device is called '" + choice + "'");
}

void Device::describePhysical() {
  info_ = describe(physical_);
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(physical_, &properties);
  limits_ = properties.limits;
  supports4Samples_ = properties.limits.framebufferColorSampleCounts &
                      properties.limits.framebufferDepthSampleCounts & VK_SAMPLE_COUNT_4_BIT;
}

Status Device::checkUsable() const {
  if (info_.unusableBecause.empty()) return Done{};
  return Error{ErrorKind::noUsableGpu,
               "",
               0,
               "",
               "the device '" + info_.name + "' cannot be used: " + info_.unusableBecause,
               "see `scumble devices`"};
}

void Device::createParts(const std::string& cacheFolder) {
  const VkCommandPoolCreateInfo info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr,
                                     VK_COMMAND_POOL_CREATE_TRANSIENT_BIT, queueFamily_};
  SCUMBLE_VK(vkCreateCommandPool(device_, &info, nullptr, &pool_));
  debugUtils_ = debugUtilsOf(instance_, device_);
  memory_ = std::make_unique<MemoryPool>(physical_, device_);
  pipelines_ = std::make_unique<PipelineStore>(device_);
  openPipelineCache(cacheFolder);
}

namespace {

Result<VkPhysicalDevice> choosePhysical(VkInstance instance, const std::string& choice) {
  const std::vector<VkPhysicalDevice> candidates = physicalDevices(instance);
  std::vector<DeviceInfo> infos;
  for (VkPhysicalDevice physical : candidates) infos.push_back(describe(physical));
  const Result<size_t> chosen = chooseDevice(infos, choice);
  if (!chosen) return chosen.error();
  return candidates[*chosen];
}

}  // namespace

Result<std::unique_ptr<Device>> Device::create(const DeviceOptions& options) {
  const VulkanWishes& wishes = options.wishes ? *options.wishes : VulkanWishes();
  Result<VkInstance> instance = createInstance(options.validation, wishes);
  if (!instance) return instance.error();
  std::unique_ptr<Device> device(new Device);
  device->log_ = options.log;
  device->instance_ = *instance;

  const Result<VkPhysicalDevice> chosen = wishes.choosePhysical
                                              ? wishes.choosePhysical(device->instance_)
                                              : choosePhysical(device->instance_, options.choice);
  if (!chosen) return chosen.error();
  device->physical_ = *chosen;
  device->describePhysical();
  if (const Status status = device->checkUsable(); !status) return status.error();

  try {
    if (options.validation) {
      VkDebugUtilsMessengerCreateInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
      info.messageSeverity =
          VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
      info.messageType =
          VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
      info.pfnUserCallback = onMessage;
      info.pUserData = device.get();
      const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
          vkGetInstanceProcAddr(device->instance_, "vkCreateDebugUtilsMessengerEXT"));
      if (create) create(device->instance_, &info, nullptr, &device->messenger_);
    }

    // Create the logical device with the required features, and what else is wanted.
    hasGraphicsQueue(device->physical_, &device->queueFamily_);
    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queueInfo{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queueInfo.queueFamilyIndex = device->queueFamily_;
    queueInfo.queueCount = 1;
    queueInfo.pQueuePriorities = &priority;
    VulkanFeatures features;
    requireVulkanFeatures(features);
    if (wishes.features) wishes.features(features);
    std::vector<const char*> extensions;
    for (const std::string& name : wishes.deviceExtensions) extensions.push_back(name.c_str());
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    info.pNext = &features.core;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queueInfo;
    info.enabledExtensionCount = uint32_t(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    if (wishes.createDevice) {
      const Result<VkDevice> made = wishes.createDevice(device->physical_, info);
      if (!made) return made.error();
      device->device_ = *made;
    } else {
      SCUMBLE_VK(vkCreateDevice(device->physical_, &info, nullptr, &device->device_));
    }
    vkGetDeviceQueue(device->device_, device->queueFamily_, 0, &device->queue_);
    device->createParts(options.cacheFolder);
  } catch (const VulkanError& error) {
    return Error{ErrorKind::noUsableGpu,
                 "",
                 0,
                 "",
                 error.message(),
                 wishes.choosePhysical ? "" : "choose another device with --device"};
  }
  return device;
}

Result<std::unique_ptr<Device>> Device::adopt(const VulkanDevice& foreign, const std::string& cacheFolder,
                                              const Log& log) {
  std::unique_ptr<Device> device(new Device);
  device->log_ = log;
  device->isForeign_ = true;
  device->instance_ = foreign.instance;
  device->physical_ = foreign.physical;
  device->device_ = foreign.device;
  device->queue_ = foreign.queue;
  device->queueFamily_ = foreign.queueFamily;
  if (foreign.queueLock) device->queueLock_ = foreign.queueLock;
  device->describePhysical();
  if (const Status status = device->checkUsable(); !status) return status.error();
  try {
    device->createParts(cacheFolder);
  } catch (const VulkanError& error) {
    return Error{ErrorKind::noUsableGpu, "", 0, "", error.message(), ""};
  }
  return device;
}

Device::Device() = default;
Device::~Device() {
  if (device_) {
    if (isForeign_) {
      const std::lock_guard lock(*queueLock_);
      vkQueueWaitIdle(queue_);
    } else {
      vkDeviceWaitIdle(device_);
    }
    if (pipelineCache_) vkDestroyPipelineCache(device_, pipelineCache_, nullptr);
    if (pool_) vkDestroyCommandPool(device_, pool_, nullptr);
    pipelines_.reset();
    memory_.reset();
    if (!isForeign_) vkDestroyDevice(device_, nullptr);
  }
  if (messenger_) {
    const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
    destroy(instance_, messenger_, nullptr);
  }
  if (instance_ && !isForeign_) vkDestroyInstance(instance_, nullptr);
}

void Device::openPipelineCache(const std::string& folder) {
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(physical_, &properties);
  if (!folder.empty()) {
    cacheFile_ = cacheFile(folder, "pipelines", properties);
    viewsFile_ = cacheFile(folder, "views", properties);
  }
  const std::vector<char> data = folder.empty() ? std::vector<char>() : readCache(cacheFile_);
  VkPipelineCacheCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
  info.initialDataSize = data.size();
  info.pInitialData = data.data();
  SCUMBLE_VK(vkCreatePipelineCache(device_, &info, nullptr, &pipelineCache_));
  // What is there before anything is compiled, some of the driver's own as well, is not worth a file.
  SCUMBLE_VK(vkGetPipelineCacheData(device_, pipelineCache_, &cachedBytes_, nullptr));
}

std::string aboutViewDrawing(uint32_t samples, std::optional<ViewDrawing> way) {
  const std::string at = " at " + std::to_string(samples) + (samples == 1 ? " sample" : " samples");
  if (!way) return "it draws two views wrongly" + at + ", whichever way: stereo is refused there";
  if (*way == ViewDrawing::separately)
    return "its multiview is wrong" + at + ": views are drawn one after the other";
  if (*way == ViewDrawing::resolvedTogether)
    return "its multiview is wrong" + at + ": views are drawn one after the other and resolved together";
  return "";
}

void Device::log(LogLevel level, const std::string& text) const {
  if (log_) log_(level, text);
}

void Device::addValidationMessage(const char* text) {
  ++validationMessages_;
  if (log_)
    log_(LogLevel::error, std::string("validation: ") + text);
  else
    std::fprintf(stderr, "scumble: validation: %s\n", text);
}

void Device::savePipelineCache() {
  if (cacheFile_.empty()) return;
  size_t size = 0;
  if (vkGetPipelineCacheData(device_, pipelineCache_, &size, nullptr) != VK_SUCCESS || size == cachedBytes_)
    return;
  std::vector<char> data(size);
  if (vkGetPipelineCacheData(device_, pipelineCache_, &size, data.data()) != VK_SUCCESS) return;
  if (!writeCache(cacheFile_, data))
    log(LogLevel::warning, "compiled pipelines cannot be kept in " + cacheFile_);
  cachedBytes_ = size;
}

void Device::requireBindable(uint64_t bytes, const char* what) const {
  if (bytes > limits_.maxStorageBufferRange) throw VulkanError{what, VK_ERROR_OUT_OF_DEVICE_MEMORY};
}

std::optional<ViewDrawing> Device::viewDrawing(uint32_t samples) {
  if (!viewDrawings_) {
    const std::string driver = info_.name + ", " + info_.driver;
    if (!viewsFile_.empty()) viewDrawings_ = readViewDrawings(viewsFile_, driver);
    if (!viewDrawings_) {
      viewDrawings_.emplace();
      viewDrawings_->of1Sample = findViewDrawing(*this, 1);
      if (supports4Samples_) viewDrawings_->of4Samples = findViewDrawing(*this, 4);
      if (!viewsFile_.empty()) writeViewDrawings(viewsFile_, driver, *viewDrawings_);
    }
    for (const uint32_t count : {1u, 4u}) {
      if (count == 4 && !supports4Samples_) continue;
      const std::string text =
          aboutViewDrawing(count, count == 1 ? viewDrawings_->of1Sample : viewDrawings_->of4Samples);
      if (!text.empty()) log(LogLevel::warning, info_.name + ": " + text);
    }
  }
  return samples == 1 ? viewDrawings_->of1Sample : viewDrawings_->of4Samples;
}

std::string Device::nameOfShader(const uint32_t* words) const {
  const auto found = shaderNames_.find(words);
  return found == shaderNames_.end() ? "shader" : found->second;
}

void Device::setName(VkObjectType type, uint64_t handle, const std::string& text) const {
  VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT};
  info.objectType = type;
  info.objectHandle = handle;
  info.pObjectName = text.c_str();
  debugUtils_.setName(device_, &info);
}

void Device::waitForSubmissions() {
  if (underWay_.empty()) return;
  SCUMBLE_VK(vkWaitForFences(device_, uint32_t(underWay_.size()), underWay_.data(), VK_TRUE, UINT64_MAX));
}

void Device::submit(VkCommandBuffer commands, const std::function<void(VkCommandBuffer)>& record,
                    VkFence done, const Around& around) {
  const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr,
                                       VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT, nullptr};
  SCUMBLE_VK(vkBeginCommandBuffer(commands, &begin));
  record(commands);
  SCUMBLE_VK(vkEndCommandBuffer(commands));
  if (around.last) around.last();
  const VkCommandBufferSubmitInfo submitted{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO, nullptr, commands,
                                            0};
  VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
  label.pLabelName = around.label.empty() ? "scumble: frame" : around.label.c_str();
  VkSubmitInfo2 info{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
  info.commandBufferInfoCount = 1;
  info.pCommandBufferInfos = &submitted;
  info.waitSemaphoreInfoCount = uint32_t(around.waits.size());
  info.pWaitSemaphoreInfos = around.waits.data();
  info.signalSemaphoreInfoCount = uint32_t(around.signals.size());
  info.pSignalSemaphoreInfos = around.signals.data();
  const std::lock_guard lock(*queueLock_);
  if (debugUtils_.beginQueueLabel) debugUtils_.beginQueueLabel(queue_, &label);
  const VkResult result = vkQueueSubmit2(queue_, 1, &info, done);
  if (debugUtils_.endQueueLabel) debugUtils_.endQueueLabel(queue_);
  SCUMBLE_VK(result);
}

void Device::runOnce(const std::function<void(VkCommandBuffer)>& record) {
  const VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool_,
                                         VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
  VkCommandBuffer commands;
  SCUMBLE_VK(vkAllocateCommandBuffers(device_, &info, &commands));
  const VkFenceCreateInfo fenceInfo{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  VkFence done;
  SCUMBLE_VK(vkCreateFence(device_, &fenceInfo, nullptr, &done));
  Around around;
  around.label = "scumble: upload";
  submit(commands, record, done, around);
  SCUMBLE_VK(vkWaitForFences(device_, 1, &done, VK_TRUE, UINT64_MAX));
  vkDestroyFence(device_, done, nullptr);
  vkFreeCommandBuffers(device_, pool_, 1, &commands);
}

}  // namespace scumble::gpu

namespace scumble {

VulkanFeatures::VulkanFeatures() {
  core.pNext = &multiview;
  multiview.pNext = &scalarBlockLayout;
  scalarBlockLayout.pNext = &bufferDeviceAddress;
  bufferDeviceAddress.pNext = &timelineSemaphore;
  timelineSemaphore.pNext = &dynamicRendering;
  dynamicRendering.pNext = &synchronization2;
  synchronization2.pNext = &maintenance4;
}

void requireVulkanFeatures(VulkanFeatures& features) {
  gpu::forEachRequired(features, [](VkBool32& feature, const char*) { feature = VK_TRUE; });
}

std::string whyUnusable(VkPhysicalDevice physical) {
  return gpu::describe(physical).unusableBecause;
}

}  // namespace scumble
