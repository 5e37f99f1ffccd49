#include "features/ocean/deform/ocean_deform.h"

#include "features/ocean/ocean.h"
#include "frame/deform_step.h"
#include "shaders/ocean_deform_comp.h"

namespace scumble::ocean {

using namespace frame;

namespace {

class OceanDeform : public Pass {
 public:
  const char* name() const override { return "ocean-deform"; }

  void declare(FrameBuilder& frame, uint32_t) override {
    if (!frame.scene().feature(kName)) return;
    const auto deform = [&](const Role& role, const Moment& moment) {
      frame.step("ocean-deform", [this, &moment](VkCommandBuffer commands) {
        const int writer = frame_->scene().feature(kName)->index;
        for (const DeformStep* const step : {&moment.waves, &moment.decorations, &moment.draped})
          step->record(commands, writer, moment.set[0]);
      });
      frame.give(role, frame.use(frame.get(role), gpu::Use::storageBufferReadWrite));
    };
    deform(kVertices, now_);
    deform(kPreviousVertices, previous_);
  }

  void create(FrameBuilder& frame) override {
    frame_ = &frame;
    layout_ =
        gpu::SetLayout(frame.device(), {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_COMPUTE_BIT}});
    hasPrevious_ = frame.scene().previousMotion() != nullptr;
    now_.create(frame, layout_, false);
    if (hasPrevious_) previous_.create(frame, layout_, true);
  }
  void bind(const gpu::GraphResources&) override {
    const auto here = frame_->scene().feature(kName);
    now_.bind(here->moment);
    if (hasPrevious_) previous_.bind(here->previous);
  }

 private:
  // Of one of the two poses.
  struct Moment {
    gpu::DescriptorSets set;
    DeformStep waves, decorations, draped;

    void create(FrameBuilder& frame, const gpu::SetLayout& layout, bool isPrevious) {
      set = gpu::DescriptorSets(frame.device(), layout);
      DeformStepDesc desc{{shaders::ocean_deform_comp}, {shared::kWaves}, isPrevious, &layout};
      waves.create(frame, desc);
      desc.constants = {shared::kDecoration};
      decorations.create(frame, desc);
      desc.constants = {shared::kDraped};
      draped.create(frame, desc);
    }
    void bind(const FeatureMoment* moment) {
      set.writeBuffer(0, 0, static_cast<const OceanWaves*>(moment)->buffer().handle());
      waves.bind(), decorations.bind(), draped.bind();
    }
  };

  FrameBuilder* frame_ = nullptr;
  gpu::SetLayout layout_;
  Moment now_, previous_;
  bool hasPrevious_ = false;
};

}  // namespace

std::unique_ptr<Pass> makeOceanDeform() {
  return std::make_unique<OceanDeform>();
}

}  // namespace scumble::ocean
