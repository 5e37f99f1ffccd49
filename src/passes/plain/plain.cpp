#include "passes/plain/plain.h"

#include "frame/geometry_step.h"
#include "shaders/plain_frag.h"
#include "shaders/plain_vert.h"

namespace scumble::passes {

using namespace frame;

namespace {

class Plain : public Pass {
 public:
  const char* name() const override { return "plain"; }

  void declare(FrameBuilder& frame) override {
    const Configuration& c = frame.configuration();
    samples_ = c.samples;
    configuration_ = frame.configuration();
    resolved_ = frame.slot(Slot::plain);
    drawn_ = samples_ > 1 ? frame.multisampled(Slot::plain) : resolved_;
    depth_ =
        frame.transient("plain depth", {VK_FORMAT_D32_SFLOAT, c.width, c.height, c.viewCount, 1, samples_});
    std::vector<gpu::ResourceUse> uses{{frame.finalVertices(), gpu::Use::vertexBuffer},
                                       {drawn_, gpu::Use::colorTarget},
                                       {depth_, gpu::Use::depthTarget}};
    if (samples_ > 1) uses.push_back({resolved_, gpu::Use::resolveTarget});
    frame.addStep("plain", std::move(uses), [this](VkCommandBuffer commands) { record(commands); });
  }

  void create(FrameBuilder& frame, const FrameResources& resources) override {
    resources_ = &resources;
    scene_ = &frame.scene();
    GeometryStepDesc desc;
    desc.vertex = {shaders::plain_vert};
    desc.fragment = {shaders::plain_frag};
    desc.inputs = kPosition | kUv0 | kUv1 | kColor;
    desc.colorFormats = {slotInfo(Slot::plain).format};
    desc.samples = samples_;
    desc.viewMask = configuration_.views().mask();
    desc.viewCount = configuration_.viewCount;
    desc.blends = true;
    step_.create(frame.device(), resources, frame.scene(), desc);
  }

 private:
  void record(VkCommandBuffer commands) const {
    const gpu::Target color{
        &resources_->image(drawn_), samples_ > 1 ? &resources_->image(resolved_) : nullptr, {}};
    const gpu::Target depth{&resources_->image(depth_), nullptr, {}};
    gpu::drawViews(commands, configuration_.views(), {&color, 1}, &depth, [&](uint32_t firstView) {
      step_.draw(commands, *resources_, *scene_, nullptr, firstView);
    });
  }

  gpu::ResourceId drawn_ = 0, resolved_ = 0, depth_ = 0;
  uint32_t samples_ = 1;
  Configuration configuration_;
  const FrameResources* resources_ = nullptr;
  const SceneOnGpu* scene_ = nullptr;
  GeometryStep step_;
};

}  // namespace

std::unique_ptr<Pass> makePlain() {
  return std::make_unique<Plain>();
}

}  // namespace scumble::passes
