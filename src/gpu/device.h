// The Vulkan device: instance, choice of GPU, one queue, the features that scumble needs (docs/gpu.md has the
// list), memory, the pipeline cache on disk, and the validation layers' messages.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gpu/debug_names.h"
#include "gpu/memory.h"
#include "gpu/vulkan.h"
#include "scumble/log.h"
#include "scumble/result.h"

namespace scumble {

// Of scumble/vulkan.h.
struct VulkanDevice;
struct VulkanWishes;

namespace gpu {

struct DeviceOptions {
  std::string choice;  // part of a name, a number in the order of listDevices(), "cpu", "gpu" (any other), or
                       // empty: the best
  bool validation = false;  // core and synchronisation validation; noUsableGpu where the layer is absent
  std::string cacheFolder;  // where compiled pipelines and what the probe found are kept; empty: nowhere
  // What somebody wants of the device besides; a device without the extensions is no usable GPU. May be null.
  const VulkanWishes* wishes = nullptr;
  Log log;  // empty: messages of the validation layers go to stderr, and others nowhere
};

// SPIR-V in place of shaders that the build compiled, by where the words of those stand.
using ShaderReplacements = std::map<const uint32_t*, std::vector<uint32_t>>;

struct DeviceInfo {
  std::string name, driver;
  uint32_t apiVersion = 0;
  bool isCpu = false, discrete = false;
  std::string unusableBecause;  // empty when scumble can use it
};

// Every Vulkan device of the machine, in the loader's order.
Result<std::vector<DeviceInfo>> listDevices();

// Index of the device that `choice` means; fails with noUsableGpu.
Result<size_t> chooseDevice(const std::vector<DeviceInfo>& devices, const std::string& choice);

class PipelineStore;

// How several views are drawn into the layers of an image, the fastest first.
enum class ViewDrawing : uint8_t {
  together,          // by multiview
  separately,        // one view after the other
  resolvedTogether,  // one view after the other; their samples are kept, and all layers resolved at once
};

// What is wrong where a device is not drawn on in the fastest way, or not at all (nothing); else empty.
std::string aboutViewDrawing(uint32_t samples, std::optional<ViewDrawing> way);

// By the number of samples; nothing where no way is right.
struct ViewDrawings {
  std::optional<ViewDrawing> of1Sample, of4Samples;
  bool operator==(const ViewDrawings&) const = default;
};

class Device {
 public:
  static Result<std::unique_ptr<Device>> create(const DeviceOptions& options);
  // Somebody else's, which outlives ours.
  static Result<std::unique_ptr<Device>> adopt(const VulkanDevice& device, const std::string& cacheFolder,
                                               const Log& log);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  VkInstance instance() const { return instance_; }
  VkDevice handle() const { return device_; }
  VkPhysicalDevice physical() const { return physical_; }
  VkQueue queue() const { return queue_; }
  uint32_t queueFamily() const { return queueFamily_; }
  // Held around each use of the queue.
  std::mutex& queueLock() const { return *queueLock_; }
  VkPipelineCache pipelineCache() const { return pipelineCache_; }
  PipelineStore& pipelines() { return *pipelines_; }
  // Before anything is made of them.
  void replaceShaders(ShaderReplacements replacements) { replacements_ = std::move(replacements); }
  const ShaderReplacements& replacedShaders() const { return replacements_; }
  // Names of shaders, by where their words stand: pipelines are called by them. Before anything is made of
  // them.
  void nameShaders(std::map<const uint32_t*, std::string> names) { shaderNames_ = std::move(names); }
  std::string nameOfShader(const uint32_t* words) const;
  // For captures and validation messages; nothing where the extension is not there.
  const DebugUtils& debugUtils() const { return debugUtils_; }
  template <class Handle>
  void name(VkObjectType type, Handle handle, const DebugName& as) const {
    if (debugUtils_.setName) setName(type, uint64_t(handle), as.text());
  }
  MemoryPool& memory() { return *memory_; }
  const DeviceInfo& info() const { return info_; }
  const VkPhysicalDeviceLimits& limits() const { return limits_; }
  // Throws VulkanError where shaders cannot read so many bytes by one binding.
  void requireBindable(uint64_t bytes, const char* what) const;
  // As if storage buffers bound no more bytes than this: for tests, before anything is made.
  void limitStorageRange(uint32_t bytes) { limits_.maxStorageBufferRange = bytes; }
  bool supports4Samples() const { return supports4Samples_; }
  // Whether image passes run faster as compute shaders. Measured: CPU drivers draw a full screen 1.45 times
  // faster than they dispatch it; servers' GPUs have few graphics units and dispatch up to 30 times faster.
  bool prefersCompute() const { return !info_.isCpu; }
  // How several views are drawn at this number of samples: found by drawing when it is first asked for, and
  // kept beside the pipeline cache. Nothing where no way gives the right pictures.
  std::optional<ViewDrawing> viewDrawing(uint32_t samples);
  bool hasTimestamps() const { return limits_.timestampComputeAndGraphics && limits_.timestampPeriod > 0; }

  // What a submission waits for and signals; `last` is called when all is recorded, just before it is sent.
  struct Around {
    std::span<const VkSemaphoreSubmitInfo> waits, signals;
    std::function<void()> last;
    std::string label;  // of the submission, for captures; a frame's where it is empty
  };
  // Records with `record` into a command buffer that was reset, and submits it; `done`, where it is not null,
  // is signalled at its end.
  void submit(VkCommandBuffer commands, const std::function<void(VkCommandBuffer)>& record, VkFence done,
              const Around& around = {});
  // The same with a command buffer of its own; waits for the end.
  void runOnce(const std::function<void(VkCommandBuffer)>& record);

  // Fences of submissions that are under way (frames_in_flight.h). waitForSubmissions() waits for them,
  // before something that they use changes, and not for a caller's work in the same queue.
  void submissionBegan(VkFence done) { underWay_.push_back(done); }
  void submissionEnded(VkFence done) { std::erase(underWay_, done); }
  void waitForSubmissions();

  // Writes the compiled pipelines to the cache folder, if there is one and something new was compiled.
  void savePipelineCache();

  // Warnings and errors of the validation layers since the start.
  int validationMessages() const { return validationMessages_; }
  // To whoever listens.
  void log(LogLevel level, const std::string& text) const;
  void addValidationMessage(const char* text);

 private:
  Device();
  void setName(VkObjectType type, uint64_t handle, const std::string& text) const;
  void describePhysical();
  Status checkUsable() const;
  void createParts(const std::string& cacheFolder);
  void openPipelineCache(const std::string& folder);

  bool isForeign_ = false;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  uint32_t queueFamily_ = 0;
  mutable std::mutex ownQueueLock_;
  std::mutex* queueLock_ = &ownQueueLock_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkPipelineCache pipelineCache_ = VK_NULL_HANDLE;
  std::string cacheFile_, viewsFile_;
  size_t cachedBytes_ = 0;
  std::unique_ptr<PipelineStore> pipelines_;
  ShaderReplacements replacements_;
  std::map<const uint32_t*, std::string> shaderNames_;
  DebugUtils debugUtils_;
  std::unique_ptr<MemoryPool> memory_;
  DeviceInfo info_;
  VkPhysicalDeviceLimits limits_{};
  std::vector<VkFence> underWay_;
  bool supports4Samples_ = false;
  std::optional<ViewDrawings> viewDrawings_;
  std::atomic<int> validationMessages_ = 0;
  Log log_;
};

}  // namespace gpu
}  // namespace scumble
