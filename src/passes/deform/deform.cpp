#include "passes/deform/deform.h"

#include "frame/deform_step.h"
#include "shaders/deform_comp.h"

namespace scumble::passes {

using namespace frame;

namespace {

class Deform : public Pass {
 public:
  const char* name() const override { return "deform"; }

  void declare(FrameBuilder& frame, uint32_t) override {
    // What has not moved keeps the vertices that an earlier frame wrote: they would come out the same.
    const auto deform = [&](const Role& role, const DeformStep& step) {
      frame.step("deform",
                 [&step](VkCommandBuffer commands) { step.record(commands, SceneMotion::kDeform); });
      frame.give(role, frame.use(frame.get(role), gpu::Use::storageBufferWrite));
    };
    deform(kVertices, now_);
    deform(kPreviousVertices, previous_);
  }

  void create(FrameBuilder& frame) override {
    hasPrevious_ = frame.scene().previousMotion() != nullptr;
    now_.create(frame, {.shader = {shaders::deform_comp}});
    if (hasPrevious_) previous_.create(frame, {.shader = {shaders::deform_comp}, .isPrevious = true});
  }
  void bind(const gpu::GraphResources&) override {
    now_.bind();
    if (hasPrevious_) previous_.bind();
  }

 private:
  DeformStep now_, previous_;
  bool hasPrevious_ = false;
};

}  // namespace

std::unique_ptr<Pass> makeDeform() {
  return std::make_unique<Deform>();
}

}  // namespace scumble::passes
