// What the program knows of ink.
#include "features/ink/drawing/drawing.h"
#include "features/ink/ink.h"
#include "features/ink/ink_knobs.h"
#include "features/ink/lines/ink_moment.h"
#include "frame/feature_parts.h"

namespace scumble::ink {

namespace {

class InkFeature : public world::Feature {
 public:
  const char* name() const override { return kName; }
  std::string_view material() const override { return ""; }
  std::shared_ptr<const world::FeaturePlan> plan(const scene::SceneData& scene,
                                                 const look::LookData& look) const override {
    return mayShow(look) ? std::make_shared<InkPlan>(mayShowPieces(scene, look)) : nullptr;
  }
  Switch onOff() const override {
    return {&InkParams::block(), "shown", "no lines are drawn; --set ink.shown=on draws them"};
  }
};

}  // namespace

std::unique_ptr<world::FeatureMoment> InkPlan::makeMoment(gpu::Device& device,
                                                          const scene::SceneData& scene) const {
  return std::make_unique<InkMoment>(device, scene, needsParts);
}

frame::FeatureParts makeFeature() {
  return {std::make_unique<InkFeature>(),
          {{"surface", makeParts},
           {"surface", makeLines},
           {"final-shadow", makeOverlay},
           {"lost-edges", makeOver, {"painting", "watercolor"}}},
          {&InkParams::block(), &LineParams::block(), &SilhouetteParams::block(), &BoundaryParams::block(),
           &MaterialBorderParams::block(), &CreaseParams::block(), &ColorBorderParams::block(),
           &ShadowShapeParams::block(), &LightStepParams::block(), &ObjectBorderParams::block(),
           &IntersectionParams::block(), &CutOutParams::block()},
          {},
          lineDrawing()};
}

}  // namespace scumble::ink
