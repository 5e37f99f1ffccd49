#include "passes/deform/deform.h"

#include <algorithm>

#include "gpu/dispatch.h"
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
    if (previous_.device) previous_.bind(*scene_, *scene_->previousMotion(), scene_->previousWaves());
  }

 private:
  // Of one of the two poses.
  struct Work {
    gpu::Device* device = nullptr;
    const gpu::SetLayout* layout = nullptr;
    gpu::DescriptorSets sets;  // by page
    gpu::Pipeline dry, waves, decorations;

    void create(frame::FrameBuilder& frame, const gpu::SetLayout& bindings, bool hasOcean,
                bool positionsOnly) {
      device = &frame.device();
      layout = &bindings;
      gpu::ComputePipelineDesc desc;
      desc.shader = {shaders::deform_comp};
      desc.sets = {frame.frameLayout().handle(), bindings.handle()};
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
      if (sets.size() < geometry.pages().size())
        sets = gpu::DescriptorSets(*device, *layout, uint32_t(geometry.pages().size()));
      for (size_t p = 0; p < geometry.pages().size(); ++p) {
        const world::VertexPage& page = geometry.pages()[p];
        uint32_t binding = 0;
        const auto whole = [&](VkBuffer buffer) { sets.writeBuffer(p, binding++, buffer); };
        // As much of a stream as the page may reach.
        const auto part = [&](const gpu::Buffer& buffer, uint32_t first, uint64_t vertexBytes) {
          const uint64_t offset = std::min(first * vertexBytes, buffer.size() - 1) / gpu::kUniformAlignment *
                                  gpu::kUniformAlignment;
          sets.writeBuffer(p, binding++, buffer.handle(), offset,
                           std::min(geometry.pageVertices() * vertexBytes, buffer.size() - offset));
        };
        whole(geometry.chunks().handle());
        whole(motion.moved());
        whole(motion.objects());
        whole(motion.joints());
        whole(motion.morphWeights());
        part(geometry.restCore(), page.firstRest, sizeof(shared::VertexCore));
        part(geometry.restFrame(), page.firstRest, sizeof(shared::VertexFrame));
        whole(geometry.restSkin().handle());
        whole(geometry.morphStarts().handle());
        whole(geometry.morphs().handle());
        part(geometry.finalCore(), page.firstFinal, sizeof(shared::VertexCore));
        part(geometry.finalFrame(), page.firstFinal, sizeof(shared::VertexFrame));
        part(scene.previousPositions(), page.firstFinal, sizeof(glm::vec3));
        whole(ocean ? ocean->buffer().handle() : motion.objects());
        part(geometry.surface(), page.firstFinal, sizeof(shared::VertexSurface));
      }
    }

    void record(VkCommandBuffer commands, VkDescriptorSet frameSet, const world::SceneMotion& motion) const {
      for (size_t p = 0; p < motion.movedOfPage().size(); ++p) {
        const world::SceneMotion::Moved& moved = motion.movedOfPage()[p];
        dispatch(commands, frameSet, sets[p], dry, moved.first, moved.beforeWater);
        for (const gpu::Pipeline* pipeline : {&waves, &decorations})
          dispatch(commands, frameSet, sets[p], *pipeline, moved.first + moved.beforeWater,
                   moved.count - moved.beforeWater);
      }
    }

    void dispatch(VkCommandBuffer commands, VkDescriptorSet frameSet, VkDescriptorSet set,
                  const gpu::Pipeline& pipeline, uint32_t first, uint32_t count) const {
      if (count == 0) return;
      pipeline.bind(commands);
      pipeline.bindSet(commands, 0, frameSet);
      pipeline.bindSet(commands, 1, set);
      pipeline.push(commands, {first, count});
      gpu::dispatch(commands, count);
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
