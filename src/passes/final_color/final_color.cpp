#include "passes/final_color/final_color.h"

#include "frame/image_step.h"
#include "passes/final_color/final_color.shared.h"
#include "shaders/final_color_image_comp.h"
#include "shaders/final_color_image_frag.h"

namespace scumble::passes {

using namespace frame;

namespace {

class FinalColor : public Pass {
 public:
  explicit FinalColor(InflationOf inflation) : inflation_(inflation) {}
  const char* name() const override { return "final-color"; }

  void declare(FrameBuilder& frame) override {
    step_.declare(frame, "final-color",
                  {{shaders::final_color_image_frag}, {shaders::final_color_image_comp}},
                  {{frame.slot(frame.configuration().colors()), true},
                   {frame.slot(Slot::warp)},
                   {frame.slot(Slot::depth)},
                   {frame.slot(Slot::blur), true},
                   {frame.slot(frame.configuration().layered ? frame.configuration().colorsBehind()
                                                             : frame.configuration().colors())},
                   {frame.slot(frame.configuration().layered ? Slot::behindDepth : Slot::depth)}},
                  frame.slot(Slot::finalColor), sizeof(shared::FinalColorUniforms),
                  {uint32_t(frame.configuration().glows), uint32_t(frame.configuration().layered)});
  }
  void create(FrameBuilder& frame, const FrameResources& resources) override {
    step_.create(frame, resources);
  }

  void update(const FrameInput& input) override {
    const FinalColorParams params = input.look.get<FinalColorParams>();
    shared::FinalColorUniforms uniforms{};
    uniforms.bloom = params.bloom * glm::vec3(params.bloomTint);
    uniforms.displacement = {inflation_(input.look, input.scene, input.uniforms.imageSize.y), params.ripple};
    step_.update(uniforms);
  }

 private:
  InflationOf inflation_;
  ImageStep step_;
};

}  // namespace

std::unique_ptr<Pass> makeFinalColor(InflationOf inflation) {
  return std::make_unique<FinalColor>(inflation);
}

}  // namespace scumble::passes
