#include "passes/shadow_map/shadow_map.h"

#include "frame/geometry_step.h"
#include "shaders/shadow_map_frag.h"
#include "shaders/shadow_map_opaque_vert.h"
#include "shaders/shadow_map_vert.h"
#include "stage/light.h"

namespace scumble::passes {

using namespace frame;

namespace {

class ShadowMap : public Pass {
 public:
  const char* name() const override { return "shadow-map"; }
  std::span<const Aov> aovs() const override { return kAovs; }

  void declare(FrameBuilder& frame, uint32_t) override {
    frame.step("shadow-map", [this](VkCommandBuffer commands) { record(commands); });
    frame.use(frame.get(kVertices), gpu::Use::vertexBuffer);
    map_ = frame.use(
        frame.image(
            "shadow-map",
            {.format = kDepthFormat, .width = kShadowMapSize, .height = kShadowMapSize, .perView = false}),
        gpu::Use::depthTarget);
    frame.give(kShadowMap, map_);
    frame.offer(kAovs[0], {map_});
  }

  void create(FrameBuilder& frame) override {
    GeometryStepDesc desc;
    desc.vertex = {shaders::shadow_map_vert};
    desc.fragment = {shaders::shadow_map_frag};
    desc.depthOnlyVertex = {shaders::shadow_map_opaque_vert};
    desc.inputs = kPosition | kUv0 | kUv1 | kColor;
    desc.depthCompare = VK_COMPARE_OP_LESS;
    desc.what = GeometryStepDesc::What::casters;
    step_.create(frame, desc);
  }
  void bind(const gpu::GraphResources& resources) override { resources_ = &resources; }
  void update(const FrameInput&) override { step_.refresh(); }

 private:
  void record(VkCommandBuffer commands) const {
    gpu::Target depth{&resources_->image(map_), nullptr, {}};
    depth.clear.depthStencil = {1.0f, 0};
    gpu::drawOnce(commands, depth, [&] { step_.draw(commands, nullptr, 0); });
  }

  static constexpr Aov kAovs[] = {
      {.name = "shadow-map", .channels = {"R"}, .needsFloat = true, .isOnce = true}};

  gpu::Handle map_;
  const gpu::GraphResources* resources_ = nullptr;
  GeometryStep step_;
};

}  // namespace

std::unique_ptr<Pass> makeShadowMap() {
  return std::make_unique<ShadowMap>();
}

}  // namespace scumble::passes
