#include "passes/shadow_map/shadow_map.h"

#include "frame/geometry_step.h"
#include "shaders/shadow_map_frag.h"
#include "shaders/shadow_map_opaque_vert.h"
#include "shaders/shadow_map_vert.h"

namespace scumble::passes {

using namespace frame;

namespace {

class ShadowMap : public Pass {
 public:
  const char* name() const override { return "shadow-map"; }

  void declare(FrameBuilder& frame) override {
    map_ = frame.slot(Slot::shadowMap);
    frame.addStep("shadow-map",
                  {{frame.finalVertices(), gpu::Use::vertexBuffer}, {map_, gpu::Use::depthTarget}},
                  [this](VkCommandBuffer commands) { record(commands); });
  }

  void create(FrameBuilder& frame, const FrameResources& resources) override {
    resources_ = &resources;
    scene_ = &frame.scene();
    GeometryStepDesc desc;
    desc.vertex = {shaders::shadow_map_vert};
    desc.fragment = {shaders::shadow_map_frag};
    desc.depthOnlyVertex = {shaders::shadow_map_opaque_vert};
    desc.inputs = kPosition | kUv0 | kUv1 | kColor;
    desc.depthCompare = VK_COMPARE_OP_LESS;
    desc.what = GeometryStepDesc::What::casters;
    step_.create(frame.device(), resources, frame.scene(), desc);
  }

 private:
  void record(VkCommandBuffer commands) const {
    gpu::Target depth{&resources_->image(map_), nullptr, {}};
    depth.clear.depthStencil = {1.0f, 0};
    gpu::drawOnce(commands, depth, [&] { step_.draw(commands, *resources_, *scene_, nullptr, 0); });
  }

  gpu::ResourceId map_ = 0;
  const FrameResources* resources_ = nullptr;
  const SceneOnGpu* scene_ = nullptr;
  GeometryStep step_;
};

}  // namespace

std::unique_ptr<Pass> makeShadowMap() {
  return std::make_unique<ShadowMap>();
}

}  // namespace scumble::passes
