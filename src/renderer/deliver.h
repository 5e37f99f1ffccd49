// Into images that are not ours: one layer of a frame's image, as one rectangle.
#pragma once

#include <string>
#include <vector>

#include "frame/pass.h"
#include "scumble/vulkan.h"

namespace scumble::renderer {

using namespace frame;

// Where one view goes; of an image itself, only what does not change from frame to frame.
struct TargetKey {
  uint32_t image = 0;  // which one of those that the frame is drawn into
  VkFormat format = VK_FORMAT_UNDEFINED;
  uint32_t width = 0, height = 0, layer = 0;  // of the image; which of its layers
  int32_t x = 0, y = 0;                       // of the rectangle
  VkImageLayout before = VK_IMAGE_LAYOUT_UNDEFINED, after = VK_IMAGE_LAYOUT_UNDEFINED;
  uint32_t view = 0;  // of those that are drawn together
  std::string aov;    // empty: the picture
  MotionUnit motion = MotionUnit::pixels;
  bool isDeviceMotion() const { return motion != MotionUnit::pixels; }
  bool isDepthBuffer() const { return format == VK_FORMAT_D32_SFLOAT; }
  bool operator==(const TargetKey&) const = default;
};

// Formats that a frame can be delivered in: of AOVs those of floats, and of `depth` that of depth buffers.
bool isTargetFormat(VkFormat format, const std::string& aov);

class Deliver {
 public:
  // `source`: what goes there, for depth buffers a depth buffer. `target`: an imported image, which it writes
  // to.
  void declare(FrameBuilder& frame, const TargetKey& key, gpu::Handle source, bool isSquareRoot,
               gpu::Handle& target, bool keepsTarget);
  void create(FrameBuilder& frame);
  void bind(const gpu::GraphResources& resources);

 private:
  void record(VkCommandBuffer commands) const;

  TargetKey key_;
  gpu::Handle source_, target_;
  bool isSquareRoot_ = false, keepsTarget_ = false;
  FrameBuilder* frame_ = nullptr;
  const gpu::GraphResources* resources_ = nullptr;
  gpu::SetLayout layout_;
  gpu::DescriptorSets set_;
  gpu::Pipeline pipeline_;
};

}  // namespace scumble::renderer
