// From device memory to pictures of floats.
#pragma once

#include "frame/pass.h"
#include "scumble/image.h"

namespace scumble::renderer {

using namespace frame;

// One AOV on its way back, in its slot's image, or several: declares the copy, and converts when the frame is
// done.
class Readback {
 public:
  void declare(FrameBuilder& frame, Slot slot);
  void create(FrameBuilder& frame, const FrameResources& resources);
  // Before a frame is recorded: which of those in flight it is.
  void setFrame(uint32_t frame) { frame_ = frame; }
  // One image a view (or one, for what is drawn once), of a frame that the device has ended. Linear, straight
  // alpha. What is drawn at a fraction of the frame's size (blur) is enlarged by linear interpolation.
  std::vector<scumble::Image> images(uint32_t frame, uint32_t width, uint32_t height) const;

 private:
  Slot slot_ = Slot::finalColor;
  std::vector<gpu::ResourceId> images_;  // of one size and format
  const FrameResources* resources_ = nullptr;
  gpu::Buffer buffers_[gpu::kFramesInFlight];
  uint32_t frame_ = 0;
};

}  // namespace scumble::renderer
