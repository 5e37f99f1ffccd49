// Lines as numbers, for who draws them by other means than pixels (drawing/).
#pragma once

#include <map>

#include "features/ink/lines/line_finder.h"

namespace scumble::ink {

class LineTable {
 public:
  // A step after LineFinder's; `numbers` and `command`: what that one has written.
  void declare(frame::FrameBuilder& frame, gpu::Handle numbers, gpu::Handle command);
  gpu::Handle image() const { return image_; }
  void create(frame::FrameBuilder& frame, const LineFinder& finder);
  void bind(const gpu::GraphResources& resources);
  void specialise(uint32_t choices);  // as LineFinder has it

 private:
  void clear(VkCommandBuffer commands) const;
  void record(VkCommandBuffer commands) const;

  frame::FrameBuilder* frame_ = nullptr;
  const LineFinder* finder_ = nullptr;
  gpu::Handle image_;
  const gpu::GraphResources* resources_ = nullptr;
  gpu::SetLayout layout_;
  gpu::DescriptorSets set_;
  uint32_t choices_ = 0;
  std::map<uint32_t, gpu::Pipeline> pipelines_;  // by choices
};

}  // namespace scumble::ink
