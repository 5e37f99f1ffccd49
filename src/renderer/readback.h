// From device memory to pictures of floats.
#pragma once

#include "frame/pass.h"
#include "scumble/image.h"

namespace scumble::renderer {

using namespace frame;

// Images on their way back, one or several of one size and format that are read as one: declares the copy,
// and converts when the frame is done.
class Readback {
 public:
  void declare(FrameBuilder& frame, const Aov& aov, const std::vector<gpu::Handle>& images);
  void bind(const gpu::GraphResources& resources);
  // Before a frame is recorded: which of those in flight it is.
  void setFrame(gpu::Device& device, uint32_t frame);
  // One image a view (or one, for what is drawn once), of a frame that the device has ended. Straight alpha.
  // What is drawn at a fraction of the frame's size is enlarged by linear interpolation.
  std::vector<scumble::Image> images(uint32_t frame, uint32_t width, uint32_t height,
                                     PixelFormat format) const;

 private:
  Aov aov_;
  std::vector<gpu::Handle> images_;
  const gpu::GraphResources* resources_ = nullptr;
  std::array<gpu::Buffer, gpu::kFramesInFlight> buffers_;  // made when they are first needed
  uint32_t frame_ = 0;
};

}  // namespace scumble::renderer
