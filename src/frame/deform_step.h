// Writes final vertices of what has moved, chunk by chunk, page by page: `deform` of most things, features of
// their own. Of the frame's pose, or of the one a frame ago.
#pragma once

#include "frame/pass.h"

namespace scumble::frame {

struct DeformStepDesc {
  gpu::Shader shader;                   // shading/deform.glsl
  std::vector<uint32_t> constants;      // from 1 on
  bool isPrevious = false;              // positions alone, of a frame ago
  const gpu::SetLayout* own = nullptr;  // set 2; null: none
};

class DeformStep {
 public:
  void create(FrameBuilder& frame, const DeformStepDesc& desc);
  // Whenever the scene's buffers have other names.
  void bind();
  // What `writer` writes (SceneMotion::moved()). `own`: set 2, or null.
  void record(VkCommandBuffer commands, int writer, VkDescriptorSet own = VK_NULL_HANDLE) const;

 private:
  const SceneMotion& motion() const {
    return isPrevious_ ? *frame_->scene().previousMotion() : frame_->scene().motion();
  }

  FrameBuilder* frame_ = nullptr;
  bool isPrevious_ = false;
  gpu::SetLayout layout_;
  gpu::DescriptorSets sets_;  // by page
  gpu::Pipeline pipeline_;
};

}  // namespace scumble::frame
