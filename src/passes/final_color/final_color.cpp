#include "passes/final_color/final_color.h"

#include <algorithm>

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
    const auto& materials = frame.scene().data().materials;
    const bool glows = std::any_of(materials.begin(), materials.end(),
                                   [](const auto& material) { return material.emissive != glm::vec3(0.0f); });
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
                  {uint32_t(glows), uint32_t(frame.configuration().layered)});
  }
  void create(FrameBuilder& frame, const FrameResources& resources) override {
    step_.create(frame, resources);
  }

  void update(const FrameInput& input) override {
    const FinalColorParams params = input.look.get<FinalColorParams>();
    shared::FinalColorUniforms uniforms{};
    uniforms.bloom = params.bloom * glm::vec3(params.bloomTint);
    uniforms.inflation = inflation_(input.look, input.scene, input.uniforms.imageSize.y);
    uniforms.ripple = params.ripple;
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
