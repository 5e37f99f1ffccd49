// Which edges are lines in a frame, found on the device: every edge is looked at once, what is found is
// counted, and its numbers are listed in the order of edges, so that the same frame has the same bytes.
#pragma once

#include <map>
#include <vector>

#include "features/ink/ink.shared.h"
#include "features/ink/lines/edges_on_gpu.h"
#include "frame/pass.h"
#include "gpu/prefix_sum.h"

namespace scumble::ink {

class LineFinder {
 public:
  // `uniforms`: InkUniforms; `lines`: an InkLine for each material.
  void create(frame::FrameBuilder& frame, const frame::UniformSlice& uniforms,
              const frame::UniformSlice& lines);
  // Whenever the scene's buffers are others.
  void bind();
  // Whether there are no edges at all: nothing can be drawn then.
  bool isEmpty() const { return !edges() || edges()->chunkCount() == 0; }
  // For InkUniforms; since the last bind().
  const shared::InkAddresses& addresses() const { return addresses_; }
  // Of the shaders that are specialised to choices (ink_choices.glsl).
  std::vector<uint32_t> constants(uint32_t choices) const;
  // What its own are specialised to; before record().
  void specialise(uint32_t choices);
  // Finds them; what reads the set afterwards needs a barrier.
  void record(VkCommandBuffer commands) const;
  // What shaders that draw lines read (ink_edge.glsl), with how many vertices there are as an indirect draw.
  const gpu::SetLayout& layout() const { return layout_; }
  VkDescriptorSet set() const { return set_[0]; }
  VkBuffer command() const { return command_.handle(); }

 private:
  // Null where the scene, as it is now, has no lines.
  const EdgesOnGpu* edges() const;

  frame::FrameBuilder* frame_ = nullptr;
  gpu::SetLayout layout_;
  gpu::DescriptorSets set_;
  struct Pipelines {
    gpu::Pipeline find, record;
  };
  std::map<uint32_t, Pipelines> pipelines_;  // by choices
  gpu::Pipeline list_;
  uint32_t choices_ = 0;
  // A word of bits for 32 edges; how many are set in it, which become sums; numbers of edges that are lines.
  uint32_t chunks_ = 0;  // that there is room for
  gpu::Buffer words_, sums_, numbers_, command_, recordsOfLines_;
  gpu::PrefixSum sum_;
  shared::InkAddresses addresses_{};
};

}  // namespace scumble::ink
