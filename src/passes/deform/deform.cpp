#include "passes/deform/deform.h"

#include <algorithm>
#include <utility>

#include "passes/deform/deform.shared.h"
#include "shaders/deform_comp.h"

namespace scumble::passes {

namespace {

class Deform : public frame::Pass {
 public:
  const char* name() const override { return "deform"; }

  void declare(frame::FrameBuilder& frame) override {
    frame.addStep("deform", {{frame.finalVertices(), gpu::Use::storageBufferWrite}},
                  [this](VkCommandBuffer commands) {
                    // Nothing moves yet: the first frame's vertices are every frame's.
                    if (std::exchange(done_, true)) return;
                    pipeline_.bind(commands);
                    pipeline_.bindSet(commands, 0, frameSet_);
                    pipeline_.bindSet(commands, 1, set_[0]);
                    const uint32_t x = std::min(chunkCount_, uint32_t(shared::kMaxGroupsX));
                    // Whole rows; chunks beyond the end are empty (SceneOnGpu pads the list).
                    if (x > 0) vkCmdDispatch(commands, x, (chunkCount_ + x - 1) / x, 1);
                  });
  }

  void create(frame::FrameBuilder& frame, const frame::FrameResources& resources) override {
    const frame::SceneOnGpu& scene = frame.scene();
    const gpu::Buffer* buffers[] = {&scene.chunks(),    &scene.restCore(), &scene.restFrame(),
                                    &scene.restSkin(),  &scene.joints(),   &scene.finalCore(),
                                    &scene.finalFrame()};
    layout_ = gpu::SetLayout(frame.device(),
                             std::vector<gpu::Binding>(std::size(buffers), {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                                                            VK_SHADER_STAGE_COMPUTE_BIT}));
    set_ = gpu::DescriptorSets(frame.device(), layout_);
    for (uint32_t i = 0; i < std::size(buffers); ++i) set_.writeBuffer(0, i, buffers[i]->handle());
    gpu::ComputePipelineDesc desc;
    desc.shader = {shaders::deform_comp};
    desc.sets = {resources.frameLayout().handle(), layout_.handle()};
    pipeline_ = gpu::Pipeline(frame.device(), desc);
    frameSet_ = resources.frameSet();
    chunkCount_ = scene.chunkCount();
  }

 private:
  gpu::SetLayout layout_;
  gpu::DescriptorSets set_;
  gpu::Pipeline pipeline_;
  VkDescriptorSet frameSet_ = VK_NULL_HANDLE;
  uint32_t chunkCount_ = 0;
  bool done_ = false;
};

}  // namespace

std::unique_ptr<frame::Pass> makeDeform() {
  return std::make_unique<Deform>();
}

}  // namespace scumble::passes
