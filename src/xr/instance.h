// The runtime that is there, and its headset.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scumble/result.h"
#include "scumble/vulkan.h"
#include "xr/functions.h"

namespace scumble::xr {

class Instance {
 public:
  // Asks for XR_KHR_vulkan_enable2, and for what else of use there is. Fails with noUsableGpu where there is
  // no loader, no runtime, or one without Vulkan.
  static Result<std::unique_ptr<Instance>> create();
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  const Functions& call() const { return call_; }
  XrInstance handle() const { return instance_; }
  bool has(const std::string& extension) const { return version(extension) > 0; }
  uint32_t version(const std::string& extension) const;  // 0: it is not there
  // With its version.
  const std::string& runtime() const { return runtime_; }

  // Looks for a headset, which may have been switched on by now. Throws XrFailure.
  void findHeadset();
  XrSystemId system() const { return system_; }
  const std::string& headset() const { return headset_; }
  // Pixels of an eye's motion that the runtime recommends (XR_FB_space_warp); none: it says nothing.
  glm::uvec2 motionSize() const { return motionSize_; }

  // Who makes Vulkan's instance and device: the runtime does, so that it can add what it needs. The instance
  // outlives who uses them.
  VulkanWishes vulkan() const;

 private:
  Instance() = default;

  Functions call_;
  XrInstance instance_ = XR_NULL_HANDLE;
  XrSystemId system_ = XR_NULL_SYSTEM_ID;
  std::map<std::string, uint32_t> extensions_;  // that were switched on, by their versions
  std::string runtime_, headset_;
  glm::uvec2 motionSize_{0};
};

}  // namespace scumble::xr
