// For programs that bring Vulkan themselves: a renderer on their device, or with what they need on its own
// one, and frames that are drawn into their images. The only public header that names Vulkan.
//
// A renderer uses one queue, and submits to it in begin(), render() and prepare(); where the program submits
// to that queue as well, it does so from the same thread, or both hold VulkanDevice::queueLock around each
// submission (Vulkan: queues are externally synchronised).
#pragma once

#include <vulkan/vulkan.h>

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "scumble/export.h"
#include "scumble/renderer.h"

namespace scumble {

// Somebody's device. It has Vulkan 1.3, a queue for graphics and compute, and what requireVulkanFeatures()
// asks for enabled.
struct VulkanDevice {
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  uint32_t queueFamily = 0;
  // Whoever uses the queue holds it meanwhile, for as long as a submission takes, not for a whole frame;
  // outlives the renderer. Null: all calls come from one thread.
  std::mutex* queueLock = nullptr;
};

// The features that scumble needs, chained, with timeline semaphores, which runtimes of headsets want: `core`
// goes into VkDeviceCreateInfo::pNext, and a program's own are chained behind `maintenance4`. Each is a
// structure by itself: who adds to the chain looks for those, and the structures of Vulkan's versions exclude
// them. It is not copied: the structures point at each other.
struct SCUMBLE_API VulkanFeatures {
  VkPhysicalDeviceFeatures2 core{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
  VkPhysicalDeviceMultiviewFeatures multiview{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MULTIVIEW_FEATURES};
  VkPhysicalDeviceScalarBlockLayoutFeatures scalarBlockLayout{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SCALAR_BLOCK_LAYOUT_FEATURES};
  VkPhysicalDeviceBufferDeviceAddressFeatures bufferDeviceAddress{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES};
  VkPhysicalDeviceTimelineSemaphoreFeatures timelineSemaphore{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES};
  VkPhysicalDeviceDynamicRenderingFeatures dynamicRendering{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES};
  VkPhysicalDeviceSynchronization2Features synchronization2{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES};
  VkPhysicalDeviceMaintenance4Features maintenance4{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES};
  VulkanFeatures();  // chained, all off
  VulkanFeatures(const VulkanFeatures&) = delete;
  VulkanFeatures& operator=(const VulkanFeatures&) = delete;
};
SCUMBLE_API void requireVulkanFeatures(VulkanFeatures& features);

// Why scumble cannot use a device; empty where it can.
SCUMBLE_API std::string whyUnusable(VkPhysicalDevice physical);

// What a program wants of the device that a renderer makes for it: names of extensions, and features, which
// `features` switches on beside those that are there. Fails with noUsableGpu where the chosen device lacks
// one.
struct VulkanWishes {
  std::vector<std::string> instanceExtensions, deviceExtensions;
  std::function<void(VulkanFeatures&)> features;
  // Who makes the instance and the device, and chooses among devices, where that is not Vulkan itself and
  // RendererOptions::device (runtimes of headsets do it); of what scumble needs, to which they may add. All
  // three or none; they throw nothing. The renderer destroys instance and device.
  std::function<Result<VkInstance>(const VkInstanceCreateInfo&)> createInstance;
  std::function<Result<VkPhysicalDevice>(VkInstance)> choosePhysical;
  std::function<Result<VkDevice>(VkPhysicalDevice, const VkDeviceCreateInfo&)> createDevice;
};
SCUMBLE_API Result<std::unique_ptr<Renderer>> createRenderer(const VulkanWishes& wishes,
                                                             const RendererOptions& options = {});

// A renderer on the program's device, which outlives it. `options.device` and `options.validation` mean
// nothing then: validation is the instance's affair.
SCUMBLE_API Result<std::unique_ptr<Renderer>> createRenderer(const VulkanDevice& device,
                                                             const RendererOptions& options = {});

// What a renderer draws with, whoever made it; valid as long as the renderer is. It has a queueLock.
SCUMBLE_API VulkanDevice vulkanDeviceOf(const Renderer& renderer);

// What motion since the frame before is told in. In normalised device coordinates there are x, y and depth
// (of the view's projection: reversed), and not of surfaces alone, but also of what is endlessly far away
// where nothing is, which moves as the view turns: as runtimes of headsets and upscalers take it.
enum class MotionUnit {
  pixels,      // x to the right, y down; 0 where nothing is
  ndc,         // y down, as Vulkan has it
  ndcUpwards,  // y up, as OpenGL has it
};

// Where one view's picture, or AOV, goes in an image of the program's. The image has the usage
// VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, or for depth formats VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, and
// one sample.
struct VulkanTarget {
  VkImage image = VK_NULL_HANDLE;
  // 8 bit RGBA or BGRA (UNORM is written in sRGB's curve, SRGB by the device's), R16G16B16A16_SFLOAT,
  // R32G32B32A32_SFLOAT; colours of the latter two are linear, and all are premultiplied by their coverage.
  // An AOV needs one of the latter two, and holds what it holds in a Frame, but premultiplied where that is
  // not. D32_SFLOAT: of the AOV `depth` alone, which is then a depth buffer by the view's own projection (1
  // at the near plane, 0 where nothing is), and costs next to nothing.
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkExtent2D extent{0, 0};  // of the whole image
  uint32_t layer = 0;
  VkOffset2D offset{0, 0};  // of the view's rectangle, which has the view's size and lies within the image
  // Before the frame, for all layers; undefined: what is in the image is lost. And after it.
  VkImageLayout before = VK_IMAGE_LAYOUT_UNDEFINED, after = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  size_t view = 0;  // index into the frame's views
  std::string aov;  // one of Renderer::aovNames(), of the view's own size; empty: the picture
  MotionUnit motion = MotionUnit::pixels;  // of the AOV `motion` alone
};

// What of a view comes back to the CPU although its frame goes into images: Frame::layers has it then, as if
// it had been asked for of all views, with images without pixels for the others. A look at what lies under a
// cursor, or what somebody else sees of the same frame, costs its own view and no more.
struct VulkanReadback {
  size_t view = 0;  // index into the frame's views; those drawn with it (of its size and rig) come as well
  std::string aov;  // one of Renderer::aovNames(); empty: the picture
};

// Names an object of the device in captures and validation messages, as the renderer's own objects are named.
// `handle` is the object's handle as a number. Does nothing where the instance lacks VK_EXT_debug_utils.
SCUMBLE_API void nameVulkanObject(const VulkanDevice& device, VkObjectType type, uint64_t handle,
                                  const std::string& name);

// Everything that one frame is drawn into. Targets in one image have the same format, extent and layouts.
struct VulkanTargets {
  std::vector<VulkanTarget> images;
  // Before anything of the frame runs, and when all of it has.
  std::vector<VkSemaphoreSubmitInfo> waits, signals;
  std::vector<VulkanReadback> readbacks;
};

// Renderer::begin(), but that the frame goes into images instead of back to the CPU; RenderOptions::aovs are
// still read back of all views, where there are some. Returns when the frame is submitted: with
// Renderer::kMaxBegun frames begun, finish() the oldest one first, which waits for it and gives its
// statistics.
SCUMBLE_API Status begin(Renderer& renderer, const Scene& scene, const Look& look, double time,
                         const std::vector<View>& views, const RenderOptions& options,
                         const VulkanTargets& targets);

}  // namespace scumble
