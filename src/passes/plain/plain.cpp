#include "passes/plain/plain.h"

#include "frame/drawn_image.h"
#include "frame/transparent_step.h"
#include "shaders/plain_frag.h"
#include "shaders/plain_transparent_frag.h"
#include "shaders/plain_transparent_vert.h"
#include "shaders/plain_vert.h"

namespace scumble::passes {

using namespace frame;

namespace {

class Plain : public Pass {
 public:
  const char* name() const override { return "plain"; }

  void declare(FrameBuilder& frame, uint32_t) override {
    configuration_ = frame.configuration();
    frame.step("plain", [this](VkCommandBuffer commands) { record(commands); });
    GeometryStep::use(frame);
    hasBlended_ = frame.has(kTransparentOrder);
    if (hasBlended_) frame.use(frame.get(kTransparentOrder), gpu::Use::indexBuffer);
    color_.declare(frame, "plain", kFormat, configuration_.samples);
    depth_ =
        frame.use(frame.image("plain depth", {.format = kDepthFormat, .samples = configuration_.samples}),
                  gpu::Use::depthTarget);
    frame.give(kPicture, color_.image());
  }

  void create(FrameBuilder& frame) override {
    GeometryStepDesc desc;
    desc.vertex = {shaders::plain_vert};
    desc.fragment = {shaders::plain_frag};
    desc.inputs = kPosition | kUv0 | kUv1 | kColor;
    desc.colorFormats = {kFormat};
    desc.samples = configuration_.samples;
    desc.viewMask = configuration_.views().mask();
    desc.viewCount = configuration_.viewCount;
    desc.leavesBlended = hasBlended_;
    step_.create(frame, desc);
    if (!hasBlended_) return;
    desc.inputs |= kNormal;
    desc.vertex = {shaders::plain_transparent_vert};
    desc.fragment = {shaders::plain_transparent_frag};
    blended_.create(frame, desc, TransparentStep::What::all);
  }
  void bind(const gpu::GraphResources& resources) override {
    resources_ = &resources;
    if (hasBlended_) blended_.bind();
  }
  void update(const FrameInput&) override {
    step_.refresh();
    if (hasBlended_) blended_.update(0);
  }

 private:
  void record(VkCommandBuffer commands) const {
    const gpu::Target color = color_.target(*resources_);
    const gpu::Target depth{&resources_->image(depth_), nullptr, {}};
    gpu::drawViews(commands, configuration_.views(), {&color, 1}, &depth, [&](uint32_t firstView) {
      step_.draw(commands, nullptr, firstView);
      if (hasBlended_) blended_.draw(commands, nullptr, firstView);
    });
  }

  static constexpr VkFormat kFormat = VK_FORMAT_R8G8B8A8_SRGB;

  DrawnImage color_;
  gpu::Handle depth_;
  Configuration configuration_;
  const gpu::GraphResources* resources_ = nullptr;
  GeometryStep step_;
  bool hasBlended_ = false;
  TransparentStep blended_;
};

}  // namespace

std::unique_ptr<Pass> makePlain() {
  return std::make_unique<Plain>();
}

}  // namespace scumble::passes
