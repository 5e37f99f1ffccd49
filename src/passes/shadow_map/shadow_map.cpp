#include "passes/shadow_map/shadow_map.h"

#include <optional>

#include "frame/geometry_step.h"
#include "passes/cull/cull_knobs.h"
#include "shaders/shadow_map_frag.h"
#include "shaders/shadow_map_opaque_vert.h"
#include "shaders/shadow_map_vert.h"
#include "shaders/shadow_veil_frag.h"
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
    GeometryStep::use(frame);
    casters_ = frame.casters();
    for (const Caster& caster : casters_)
      for (const auto& [handle, use] : caster.reads) frame.use(handle, use);
    map_ = frame.use(
        frame.keptImage(
            "shadow-map",
            {.format = kDepthFormat, .width = kShadowMapSize, .height = kShadowMapSize, .perView = false}),
        gpu::Use::depthTarget);
    frame.give(kShadowMap, map_);
    frame.offer(kAovs[0], {map_});
    hasVeils_ = frame.has(kTransparentOrder);
    if (!hasVeils_) return;
    frame.step("veils", [this](VkCommandBuffer commands) { recordVeils(commands); });
    GeometryStep::use(frame);
    veils_ = frame.use(
        frame.keptImage(
            kVeils.name,
            {.format = kHalves, .width = kShadowMapSize, .height = kShadowMapSize, .perView = false}),
        gpu::Use::colorTarget);
    frame.use(map_, gpu::Use::depthTest);
    frame.give(kVeils, veils_);
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
    if (!hasVeils_) return;
    desc.fragment = {shaders::shadow_veil_frag};
    desc.depthOnlyVertex = {};
    desc.colorFormats = {kHalves};
    desc.blend = gpu::Blend::greatest;
    desc.onlyBlended = true;
    desc.depthWrite = false;
    veilStep_.create(frame, desc);
  }
  void bind(const gpu::GraphResources& resources) override {
    resources_ = &resources;
    drawn_.reset();
    veilsDrawn_.reset();
  }
  void update(const FrameInput& input) override {
    step_.refresh();
    if (hasVeils_) veilStep_.refresh();
    const shared::FrameUniforms& u = input.uniforms;
    std::vector<uint64_t> others;
    for (const Caster& caster : casters_) others.push_back(caster.version());
    wanted_ = {input.scene.castersVersion(),
               std::move(others),
               input.knobs.scene<LevelsParams>().error,
               u.worldToLight,
               u.shadowCenter,
               u.shadowScale,
               u.shadowEven,
               u.shadowShift,
               u.shadowWarp};
  }

 private:
  // All that the map is made from.
  struct Content {
    uint64_t surfaces;
    std::vector<uint64_t> others;
    float levels;
    glm::mat4 worldToLight;
    glm::vec2 center, scale;
    float even;
    glm::vec2 shift;
    float warp;
    bool operator==(const Content&) const = default;
  };

  // What the last frame has left there may be the same.
  void record(VkCommandBuffer commands) {
    if (drawn_ == wanted_) return;
    drawn_ = wanted_;
    gpu::Target depth{&resources_->image(map_), nullptr, {}};
    depth.clear.depthStencil = {1.0f, 0};
    gpu::drawOnce(commands, {}, &depth, [&] {
      step_.draw(commands, nullptr, 0);
      for (const Caster& caster : casters_) caster.draw(commands);
    });
  }
  void recordVeils(VkCommandBuffer commands) {
    if (veilsDrawn_ == wanted_) return;
    veilsDrawn_ = wanted_;
    const gpu::Target veils{&resources_->image(veils_), nullptr, {}};
    const gpu::Target depth{&resources_->image(map_), nullptr, {}, gpu::Target::Before::tested};
    gpu::drawOnce(commands, {&veils, 1}, &depth, [&] { veilStep_.draw(commands, nullptr, 0); });
  }

  static constexpr Aov kAovs[] = {
      {.name = "shadow-map", .channels = {"R"}, .needsFloat = true, .isOnce = true, .hasOwnSize = true}};

  std::vector<Caster> casters_;
  std::optional<Content> drawn_, veilsDrawn_;
  Content wanted_{};
  gpu::Handle map_;
  const gpu::GraphResources* resources_ = nullptr;
  GeometryStep step_;
  bool hasVeils_ = false;
  gpu::Handle veils_;
  GeometryStep veilStep_;
};

}  // namespace

std::unique_ptr<Pass> makeShadowMap() {
  return std::make_unique<ShadowMap>();
}

}  // namespace scumble::passes
