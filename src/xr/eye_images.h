// What both eyes are drawn into: an array of two layers, or, where the runtime has none, two images.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "xr/swapchain.h"

namespace scumble::xr {

constexpr size_t kEyes = 2;

class EyeImages {
 public:
  // `size`: of an eye, pixels. Depth buffers are D32. Throws XrFailure, as all calls here do.
  EyeImages(const Functions& call, XrSession session, VkFormat format, glm::uvec2 size);

  glm::uvec2 size() const { return size_; }
  // The next ones, as targets of the views `firstView` and the one after it, until release().
  std::vector<VulkanTarget> acquire(size_t firstView, const std::string& aov = "");
  void release();
  // The upper left corner of what an eye was given last, for layers of a frame.
  XrSwapchainSubImage part(size_t eye, glm::uvec2 size) const;

 private:
  size_t chainOf(size_t eye) const { return chains_.size() == 1 ? 0 : eye; }
  uint32_t layerOf(size_t eye) const { return chains_.size() == 1 ? uint32_t(eye) : 0; }

  glm::uvec2 size_;
  bool isDepth_;
  std::vector<std::unique_ptr<Swapchain>> chains_;
};

// What runtimes are told of our depths, by any of the structures that have these members: reversed, so that 0
// is endlessly far away, and nearZ, which is where minDepth lies, is the farther one. Metres of the room.
template <class Info>
void tellDepths(Info& info, float nearPlane) {
  info.minDepth = 0, info.nearZ = std::numeric_limits<float>::infinity();
  info.maxDepth = 1, info.farZ = nearPlane;
}

}  // namespace scumble::xr
