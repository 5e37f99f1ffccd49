#include "passes/order/order.h"

#include <algorithm>

#include "gpu/dispatch.h"
#include "gpu/prefix_sum.h"
#include "passes/order/order.shared.h"
#include "shaders/order_comp.h"
#include "shading/geometry_constants.shared.h"

namespace scumble::passes {

using namespace frame;

namespace {

class Order : public Pass {
 public:
  const char* name() const override { return "order"; }
  uint32_t variant(const scene::SceneData& scene, const look::LookData&) const override {
    return std::any_of(scene.materials.begin(), scene.materials.end(), [](const scene::Material& material) {
      return material.alphaMode == scene::AlphaMode::blend;
    });
  }

  void declare(FrameBuilder& frame, uint32_t hasBlended) override {
    if (!hasBlended) return;
    const gpu::Handle order = frame.graph().importBuffer(kTransparentOrder.name);
    frame.step("order", [this](VkCommandBuffer commands) { record(commands); });
    frame.use(frame.get(kVertices), gpu::Use::storageBufferRead);
    frame.give(kTransparentOrder, frame.use(order, gpu::Use::storageBufferWrite));
  }

  void create(FrameBuilder& frame) override {
    frame_ = &frame;
    layout_ = gpu::SetLayout(frame.device(), std::vector<gpu::Binding>(6, {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                                                           VK_SHADER_STAGE_COMPUTE_BIT}));
    set_ = gpu::DescriptorSets(frame.device(), layout_);
    gpu::ComputePipelineDesc desc;
    desc.shader = {shaders::order_comp};
    desc.sets = {frame.frameLayout().handle(), layout_.handle()};
    desc.pushConstantBytes = 4;
    desc.constants.resize(size_t(shared::kPassId) + 1);
    desc.constants[size_t(shared::kViewCountId)] = frame.configuration().viewCount;
    keys_ = gpu::Pipeline(frame.device(), desc);
    desc.constants[size_t(shared::kPassId)] = 1;
    gather_ = gpu::Pipeline(frame.device(), desc);
  }

  void bind(const gpu::GraphResources&) override {
    const TransparentTriangles& triangles = frame_->scene().transparent();
    if (sort_.most() < std::max(1u, triangles.count()))
      sort_ = gpu::RadixSort(frame_->device(), triangles.count(), 24);
    const VkBuffer buffers[] = {
        triangles.triangles(), triangles.parts(),       frame_->scene().geometry().finalCore().handle(),
        sort_.keys().handle(), sort_.values().handle(), triangles.indices()};
    for (uint32_t i = 0; i < std::size(buffers); ++i) set_.writeBuffer(0, i, buffers[i]);
  }

 private:
  void record(VkCommandBuffer commands) const {
    if (!frame_->scene().transparent().isVisible()) return;
    const uint32_t count = frame_->scene().transparent().count();
    const auto run = [&](const gpu::Pipeline& pipeline) {
      gpu::computeBarrier(commands);
      pipeline.bind(commands);
      pipeline.bindSet(commands, 0, frame_->frameSet());
      pipeline.bindSet(commands, 1, set_[0]);
      pipeline.push(commands, count);
      gpu::dispatch(commands, (count + shared::kOrderThreads - 1) / shared::kOrderThreads);
    };
    run(keys_);
    sort_.record(commands, count);
    run(gather_);
  }

  FrameBuilder* frame_ = nullptr;
  gpu::SetLayout layout_;
  gpu::DescriptorSets set_;
  gpu::Pipeline keys_, gather_;
  gpu::RadixSort sort_;
};

}  // namespace

std::unique_ptr<Pass> makeOrder() {
  return std::make_unique<Order>();
}

}  // namespace scumble::passes
