#include "frame/deform_step.h"

#include <algorithm>

#include "gpu/dispatch.h"

namespace scumble::frame {

void DeformStep::create(FrameBuilder& frame, const DeformStepDesc& desc) {
  frame_ = &frame;
  isPrevious_ = desc.isPrevious;
  layout_ = gpu::SetLayout(frame.device(), std::vector<gpu::Binding>(14, {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                                                          VK_SHADER_STAGE_COMPUTE_BIT}));
  gpu::ComputePipelineDesc pipeline;
  pipeline.shader = desc.shader;
  pipeline.sets = {frame.frameLayout().handle(), layout_.handle()};
  if (desc.own) pipeline.sets.push_back(desc.own->handle());
  pipeline.pushConstantBytes = 8;
  pipeline.constants = {desc.isPrevious};
  pipeline.constants.insert(pipeline.constants.end(), desc.constants.begin(), desc.constants.end());
  pipeline_ = gpu::Pipeline(frame.device(), pipeline);
}

void DeformStep::bind() {
  const SceneOnGpu& scene = frame_->scene();
  const GeometryOnGpu& geometry = scene.geometry();
  if (sets_.size() < geometry.pages().size())
    sets_ = gpu::DescriptorSets(frame_->device(), layout_, uint32_t(geometry.pages().size()));
  for (size_t p = 0; p < geometry.pages().size(); ++p) {
    const VertexPage& page = geometry.pages()[p];
    uint32_t binding = 0;
    const auto whole = [&](VkBuffer buffer) { sets_.writeBuffer(p, binding++, buffer); };
    // As much of a stream as the page may reach.
    const auto part = [&](const gpu::Buffer& buffer, uint32_t first, uint64_t vertexBytes) {
      const uint64_t offset =
          std::min(first * vertexBytes, buffer.size() - 1) / gpu::kUniformAlignment * gpu::kUniformAlignment;
      sets_.writeBuffer(p, binding++, buffer.handle(), offset,
                        std::min(geometry.pageVertices() * vertexBytes, buffer.size() - offset));
    };
    whole(geometry.chunks().handle());
    whole(motion().moved());
    whole(motion().objects());
    whole(motion().joints());
    whole(motion().morphWeights());
    part(geometry.restCore(), page.firstRest, sizeof(shared::VertexCore));
    part(geometry.restFrame(), page.firstRest, sizeof(shared::VertexFrame));
    whole(geometry.restSkin().handle());
    whole(geometry.morphStarts().handle());
    whole(geometry.morphs().handle());
    part(geometry.finalCore(), page.firstFinal, sizeof(shared::VertexCore));
    part(geometry.finalFrame(), page.firstFinal, sizeof(shared::VertexFrame));
    part(scene.previousPositions(), page.firstFinal, sizeof(glm::vec3));
    part(geometry.patternUv(), page.firstFinal, sizeof(glm::vec2));
  }
}

void DeformStep::record(VkCommandBuffer commands, int writer, VkDescriptorSet own) const {
  bool isBound = false;
  for (size_t p = 0; p < frame_->scene().geometry().pages().size(); ++p) {
    const SceneMotion::Moved moved = motion().moved(p, writer);
    if (moved.count == 0) continue;
    if (!isBound) {
      pipeline_.bind(commands);
      pipeline_.bindSet(commands, 0, frame_->frameSet());
      if (own) pipeline_.bindSet(commands, 2, own);
      isBound = true;
    }
    pipeline_.bindSet(commands, 1, sets_[p]);
    pipeline_.push(commands, {moved.first, moved.count});
    gpu::dispatch(commands, moved.count);
  }
}

}  // namespace scumble::frame
