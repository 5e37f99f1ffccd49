// What geometry is drawn into: an image of a layer a view, with the frame's samples where they are several,
// which are resolved at the end of the step.
#pragma once

#include "frame/pass.h"

namespace scumble::frame {

class DrawnImage {
 public:
  // A use of the step that is being declared.
  void declare(FrameBuilder& frame, const std::string& name, VkFormat format, uint32_t samples = 1);
  // Of a later step that draws over what is there: of one sample.
  void declareAgain(FrameBuilder& frame);
  gpu::Handle image() const { return image_; }      // one sample a pixel
  gpu::Handle samples() const { return samples_; }  // the same where there is but one
  gpu::Target target(const gpu::GraphResources& resources, VkClearValue clear = {},
                     gpu::Target::Before before = gpu::Target::Before::cleared) const;

 private:
  gpu::Handle image_, samples_;
};

}  // namespace scumble::frame
