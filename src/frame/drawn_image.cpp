#include "frame/drawn_image.h"

#include <cassert>

namespace scumble::frame {

void DrawnImage::declare(FrameBuilder& frame, const std::string& name, VkFormat format, uint32_t samples) {
  const bool isDepth = gpu::isDepthFormat(format);
  const gpu::Use drawn = isDepth ? gpu::Use::depthTarget : gpu::Use::colorTarget;
  image_ = frame.image(name, {.format = format});
  if (samples == 1) {
    samples_ = image_ = frame.use(image_, drawn);
    return;
  }
  samples_ = frame.use(frame.image(name + " samples", {.format = format, .samples = samples}), drawn);
  image_ = frame.use(image_, isDepth ? gpu::Use::depthResolveTarget : gpu::Use::resolveTarget);
}

void DrawnImage::declareAgain(FrameBuilder& frame) {
  assert(samples_ == image_);
  samples_ = image_ = frame.use(image_, gpu::Use::colorTarget);
}

gpu::Target DrawnImage::target(const gpu::GraphResources& resources, VkClearValue clear,
                               gpu::Target::Before before) const {
  return {&resources.image(samples_), samples_ == image_ ? nullptr : &resources.image(image_), clear, before};
}

}  // namespace scumble::frame
