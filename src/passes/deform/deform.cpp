#include "passes/deform/deform.h"

#include <algorithm>

#include "passes/deform/deform.shared.h"
#include "shaders/deform_comp.h"

namespace scumble::passes {

namespace {

class Deform : public frame::Pass {
 public:
  const char* name() const override { return "deform"; }

  void declare(frame::FrameBuilder& frame, uint32_t) override {
    // What has not moved keeps the vertices that an earlier frame wrote: they would come out the same.
    const auto deform = [&](const frame::Role& role, frame::Record record) {
      frame.step("deform", std::move(record));
      frame.give(role, frame.use(frame.get(role), gpu::Use::storageBufferWrite));
    };
    deform(frame::kVertices,
           [this](VkCommandBuffer commands) { now_.record(commands, frameSet_, scene_->motion()); });
    deform(frame::kPreviousVertices, [this](VkCommandBuffer commands) {
      previous_.record(commands, frameSet_, *scene_->previousMotion());
    });
  }

  void create(frame::FrameBuilder& frame) override {
    scene_ = &frame.scene();
    frameSet_ = frame.frameSet();
    layout_ = gpu::SetLayout(frame.device(), std::vector<gpu::Binding>(15, {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                                                            VK_SHADER_STAGE_COMPUTE_BIT}));
    now_.create(frame, layout_, scene_->waves() != nullptr, false);
    if (scene_->previousMotion()) previous_.create(frame, layout_, scene_->waves() != nullptr, true);
  }
  void bind(const gpu::GraphResources&) override {
    now_.bind(*scene_, scene_->motion(), scene_->waves());
    if (previous_.set.size() > 0) previous_.bind(*scene_, *scene_->previousMotion(), scene_->previousWaves());
  }

 private:
  // Of one of the two poses.
  struct Work {
    gpu::DescriptorSets set;
    gpu::Pipeline dry, waves, decorations;

    void create(frame::FrameBuilder& frame, const gpu::SetLayout& layout, bool hasOcean, bool positionsOnly) {
      set = gpu::DescriptorSets(frame.device(), layout);
      gpu::ComputePipelineDesc desc;
      desc.shader = {shaders::deform_comp};
      desc.sets = {frame.frameLayout().handle(), layout.handle()};
      desc.pushConstantBytes = 8;
      desc.constants = {positionsOnly, 0};
      dry = gpu::Pipeline(frame.device(), desc);
      if (!hasOcean) return;
      desc.constants = {positionsOnly, shared::kWaves};
      waves = gpu::Pipeline(frame.device(), desc);
      desc.constants = {positionsOnly, shared::kDecoration};
      decorations = gpu::Pipeline(frame.device(), desc);
    }

    void bind(const world::SceneOnGpu& scene, const world::SceneMotion& motion,
              const world::OceanWaves* ocean) {
      const world::GeometryOnGpu& geometry = scene.geometry();
      const VkBuffer buffers[] = {geometry.chunks().handle(),
                                  motion.moved(),
                                  motion.objects(),
                                  motion.joints(),
                                  motion.morphWeights(),
                                  geometry.restCore().handle(),
                                  geometry.restFrame().handle(),
                                  geometry.restSkin().handle(),
                                  geometry.morphStarts().handle(),
                                  geometry.morphs().handle(),
                                  geometry.finalCore().handle(),
                                  geometry.finalFrame().handle(),
                                  scene.previousPositions().handle(),
                                  ocean ? ocean->buffer().handle() : motion.objects(),
                                  geometry.surface().handle()};
      for (uint32_t i = 0; i < std::size(buffers); ++i) set.writeBuffer(0, i, buffers[i]);
    }

    void record(VkCommandBuffer commands, VkDescriptorSet frameSet, const world::SceneMotion& motion) const {
      const uint32_t dryCount = motion.movedBeforeWater();
      dispatch(commands, frameSet, dry, 0, dryCount);
      for (const gpu::Pipeline* pipeline : {&waves, &decorations})
        dispatch(commands, frameSet, *pipeline, dryCount, motion.movedCount() - dryCount);
    }

    void dispatch(VkCommandBuffer commands, VkDescriptorSet frameSet, const gpu::Pipeline& pipeline,
                  uint32_t first, uint32_t count) const {
      if (count == 0) return;
      pipeline.bind(commands);
      pipeline.bindSet(commands, 0, frameSet);
      pipeline.bindSet(commands, 1, set[0]);
      pipeline.push(commands, {first, count});
      const uint32_t x = std::min(count, uint32_t(shared::kMaxGroupsX));
      vkCmdDispatch(commands, x, (count + x - 1) / x, 1);
    }
  };

  gpu::SetLayout layout_;
  Work now_, previous_;
  const world::SceneOnGpu* scene_ = nullptr;
  VkDescriptorSet frameSet_ = VK_NULL_HANDLE;
};

}  // namespace

std::unique_ptr<frame::Pass> makeDeform() {
  return std::make_unique<Deform>();
}

}  // namespace scumble::passes
