// Draws layers of paint (scene::PaintLayer): fins and coats of all objects, in one order.
#pragma once

#include "frame/pass.h"
#include "frame/transparent_step.h"

namespace scumble::painting {

class Fins {
 public:
  // Uses of the step that draws them.
  void declare(frame::FrameBuilder& frame);
  // Of the images that they are drawn into: paint, and where it counts how far away that is.
  void create(frame::FrameBuilder& frame, const std::vector<VkFormat>& formats);
  void bind() { step_.bind(); }
  void update(const frame::FrameInput& input);
  void draw(VkCommandBuffer commands, const gpu::GraphResources& resources,
            std::span<const gpu::Target> targets) const;

 private:
  frame::FrameBuilder* frame_ = nullptr;
  gpu::Handle depth_;
  frame::UniformSlice uniforms_;
  gpu::SetLayout layout_;
  gpu::DescriptorSets set_;
  frame::TransparentStep step_;
};

}  // namespace scumble::painting
