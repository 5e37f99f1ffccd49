// How far the painting reaches, where it runs out before the frame does: for what is drawn over it.
#include "features/watercolor/wash/paper.h"
#include "features/watercolor/watercolor.h"
#include "features/watercolor/watercolor_knobs.h"
#include "frame/image_step.h"
#include "shaders/wash_extent_image_comp.h"
#include "shaders/wash_extent_image_frag.h"

namespace scumble::watercolor {

using namespace frame;

namespace {

class Extent : public Pass {
 public:
  const char* name() const override { return "wash-extent"; }
  uint32_t variant(const scene::SceneData&, const look::LookData& look) const override {
    return mayShow(look) && look.get<WatercolorParams>().margin > 0;
  }
  void declare(FrameBuilder& frame, uint32_t ends) override {
    if (!ends || frame.configuration().onSphere) return;
    frame.give(kPaintedExtent, step_.declare(frame, {.name = name(),
                                                     .shader = {{shaders::wash_extent_image_frag},
                                                                {shaders::wash_extent_image_comp}},
                                                     .textures = {shared::kExtentPaper, shared::kExtentBroad},
                                                     .outputs = {frame.image(name(), {.format = kBytes})},
                                                     .fetches = 3 * 4,
                                                     .uniformBytes = sizeof(shared::WashUniforms)})[0]);
  }
  void create(FrameBuilder& frame) override {
    frame_ = &frame;
    step_.create(frame);
  }
  void bind(const gpu::GraphResources& resources) override { step_.bind(resources); }
  void update(const FrameInput& input) override {
    const shared::WashUniforms u = paperUniforms(input, frame_->configuration());
    step_.update(u);
    const ExampleTexture& paper =
        frame_->examples().get(input.look, input.knobs.scene<WatercolorParams>().paper);
    step_.setJobs({{{},
                    {{shared::kExtentPaper, &paper.image, paperSampler(paper, u.paperSize)},
                     {shared::kExtentBroad, &paper.image, kBroadSampler}}}});
  }

 private:
  FrameBuilder* frame_ = nullptr;
  ImageStep step_;
};

}  // namespace

std::unique_ptr<Pass> makeExtent() {
  return std::make_unique<Extent>();
}

}  // namespace scumble::watercolor
