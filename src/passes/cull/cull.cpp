#include "passes/cull/cull.h"

#include <algorithm>
#include <bit>

#include "gpu/dispatch.h"
#include "gpu/prefix_sum.h"
#include "passes/cull/cull.shared.h"
#include "passes/cull/cull_knobs.h"
#include "shaders/cull_comp.h"
#include "shading/geometry_constants.shared.h"
#include "stage/light.h"

namespace scumble::passes {

using namespace frame;

namespace {

class Cull : public Pass {
 public:
  explicit Cull(bool hasLevels) : hasLevels_(hasLevels) {}
  const char* name() const override { return "cull"; }

  void declare(FrameBuilder& frame, uint32_t) override {
    const gpu::Handle list = frame.graph().importBuffer(kDrawList.name);
    frame.step("cull", [this](VkCommandBuffer commands) { record(commands); });
    frame.give(kDrawList, frame.use(list, gpu::Use::storageBufferWrite));
    frame.give(kDrawnObjects,
               frame.use(frame.graph().importBuffer(kDrawnObjects.name), gpu::Use::storageBufferWrite));
  }

  void create(FrameBuilder& frame) override {
    frame_ = &frame;
    uniforms_ = frame.uniform(sizeof(shared::CullUniforms));
    std::vector<gpu::Binding> bindings(10, {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_COMPUTE_BIT});
    bindings[0].type = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    layout_ = gpu::SetLayout(frame.device(), std::move(bindings));
    set_ = gpu::DescriptorSets(frame.device(), layout_);
    set_.writeBuffer(0, 0, uniforms_.buffer, uniforms_.offset, uniforms_.size);
    gpu::ComputePipelineDesc desc;
    desc.shader = {shaders::cull_comp};
    desc.sets = {frame.frameLayout().handle(), layout_.handle()};
    desc.constants.resize(size_t(shared::kPassId) + 1);
    desc.constants[size_t(shared::kViewCountId)] = frame.configuration().viewCount;
    keys_ = gpu::Pipeline(frame.device(), desc);
    desc.constants[size_t(shared::kPassId)] = 1;
    gather_ = gpu::Pipeline(frame.device(), desc);
  }

  void bind(const gpu::GraphResources&) override {
    const DrawList& list = frame_->scene().draws();
    if (sort_.most() < list.room()) sort_ = gpu::RadixSort(frame_->device(), list.room());
    const VkBuffer buffers[] = {list.commands(),         list.places(), sort_.keys().handle(),
                                sort_.values().handle(), list.seen(),   list.casters(),
                                list.levels(),           list.torn(),   list.drawn()};
    for (uint32_t i = 0; i < std::size(buffers); ++i) set_.writeBuffer(0, 1 + i, buffers[i]);
  }

  void update(const FrameInput& input) override {
    const DrawList& list = input.scene.draws();
    // At least one bit tells what is seen, and one is left for distances.
    const uint32_t bucketBits = uint32_t(std::bit_width(std::max<size_t>(1, list.buckets().size()) - 1));
    shared::CullUniforms uniforms{};
    uniforms.margin = 2.0f * (input.inflation + 1) / input.uniforms.imageSize;
    uniforms.draws = list.count();
    uniforms.bucketShift = std::min(31u, 32u - bucketBits);
    if (hasLevels_) uniforms.error = input.knobs.scene<LevelsParams>().error;
    for (uint32_t v = 0; v < frame_->configuration().viewCount; ++v)
      uniforms.rigRadius =
          std::max(uniforms.rigRadius, glm::distance(input.uniforms.views[v].eye, input.uniforms.viewer));
    for (size_t m = 0; m < input.scene.materialCount(); ++m)
      if (input.scene.colorSets(m) != 0) uniforms.textures = shared::kTexturesColor;
    uniforms.longestEdge = input.scene.longestCasterEdge();
    uniforms.mapSize = float(kShadowMapSize);
    uniforms_.write(uniforms);
  }

 private:
  void record(VkCommandBuffer commands) const {
    const uint32_t count = frame_->scene().draws().count();
    if (count == 0) return;
    const auto run = [&](const gpu::Pipeline& pipeline) {
      gpu::computeBarrier(commands);
      pipeline.bind(commands);
      pipeline.bindSet(commands, 0, frame_->frameSet());
      pipeline.bindSet(commands, 1, set_[0]);
      gpu::dispatch(commands, (count + shared::kCullThreads - 1) / shared::kCullThreads);
    };
    run(keys_);
    sort_.record(commands, count);
    run(gather_);
  }

  bool hasLevels_;
  FrameBuilder* frame_ = nullptr;
  UniformSlice uniforms_;
  gpu::SetLayout layout_;
  gpu::DescriptorSets set_;
  gpu::Pipeline keys_, gather_;
  gpu::RadixSort sort_;
};

}  // namespace

std::unique_ptr<Pass> makeCull() {
  return std::make_unique<Cull>(true);
}

std::unique_ptr<Pass> makeCullOfWholes() {
  return std::make_unique<Cull>(false);
}

}  // namespace scumble::passes
