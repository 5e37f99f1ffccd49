// Draws which piece of which mesh is seen, where lines follow from that.
#include "features/ink/ink.h"
#include "features/ink/ink_knobs.h"
#include "features/ink/lines/ink_moment.h"
#include "frame/drawn_image.h"
#include "frame/geometry_step.h"
#include "shaders/ink_parts_frag.h"
#include "shaders/ink_parts_vert.h"

namespace scumble::ink {

using namespace frame;

namespace {

class Parts : public Pass {
 public:
  const char* name() const override { return "ink-parts"; }
  uint32_t variant(const scene::SceneData& scene, const look::LookData& look) const override {
    return mayShowPieces(scene, look);
  }

  void declare(FrameBuilder& frame, uint32_t isShown) override {
    isShown_ = isShown;
    if (!isShown_) return;
    configuration_ = frame.configuration();
    frame.step(name(), [this](VkCommandBuffer commands) { record(commands); });
    GeometryStep::use(frame);
    depth_.declare(frame, "ink parts depth", kDepthFormat);
    parts_.declare(frame, "ink parts", kFloats);
    frame.give(kPieces, parts_.image());
    frame.offer(kAovs[0], {parts_.image()});
  }

  void create(FrameBuilder& frame) override {
    if (!isShown_) return;
    frame_ = &frame;
    layout_ =
        gpu::SetLayout(frame.device(), {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_VERTEX_BIT}});
    sets_ = gpu::DescriptorSets(frame.device(), layout_);
    GeometryStepDesc desc;
    desc.vertex = {shaders::ink_parts_vert};
    desc.fragment = {shaders::ink_parts_frag};
    desc.inputs = kPosition | kUv0 | kUv1 | kColor;
    desc.colorFormats = {kFloats};
    desc.viewMask = configuration_.views().mask();
    desc.viewCount = configuration_.viewCount;
    desc.passLayout = &layout_;
    step_.create(frame, desc);
  }

  void bind(const gpu::GraphResources& resources) override {
    resources_ = &resources;
    if (!isShown_) return;
    const auto here = frame_->scene().feature(kName);
    if (!here) return;
    // A look that draws none of this has none, before its own steps are declared.
    if (const gpu::Buffer& parts = static_cast<const InkMoment*>(here->moment)->parts().parts();
        parts.handle())
      sets_.writeBuffer(0, 0, parts.handle());
  }

  void update(const FrameInput&) override {
    if (isShown_) step_.refresh();
  }

 private:
  void record(VkCommandBuffer commands) const {
    const gpu::Target parts = parts_.target(*resources_), depth = depth_.target(*resources_);
    gpu::drawViews(commands, configuration_.views(), {&parts, 1}, &depth,
                   [&](uint32_t firstView) { step_.draw(commands, &sets_, firstView); });
  }

  static constexpr Aov kAovs[] = {{.name = kPiecesAov, .needsFloat = true, .isInternal = true}};

  FrameBuilder* frame_ = nullptr;
  bool isShown_ = false;
  Configuration configuration_;
  DrawnImage parts_, depth_;
  const gpu::GraphResources* resources_ = nullptr;
  gpu::SetLayout layout_;
  gpu::DescriptorSets sets_;
  GeometryStep step_;
};

}  // namespace

std::unique_ptr<Pass> makeParts() {
  return std::make_unique<Parts>();
}

}  // namespace scumble::ink
