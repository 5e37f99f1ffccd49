// What the program knows of the ocean.
#include "features/ocean/deform/ocean_deform.h"
#include "features/ocean/extras.h"
#include "features/ocean/ocean.h"
#include "features/ocean/paint/ocean.h"
#include "features/ocean/paint/ocean_knobs.h"
#include "frame/feature_parts.h"

namespace scumble::ocean {

namespace {

class OceanFeature : public Feature {
 public:
  const char* name() const override { return kName; }
  std::string_view material() const override { return "Ocean"; }
  std::shared_ptr<const FeaturePlan> plan(const scene::SceneData& scene,
                                          const look::LookData& look) const override {
    OceanShape shape = oceanShape(scene, look);
    return shape.isThere ? std::make_shared<OceanPlan>(std::move(shape)) : nullptr;
  }
  Switch onOff() const override {
    return {&OceanParams::block(), "mode", "there is no ocean; --set ocean.mode=on puts one"};
  }
};

}  // namespace

frame::FeatureParts makeFeature() {
  return {std::make_unique<OceanFeature>(),
          {{"deform", makeOceanDeform}, {"shadow-map", makeOcean}},
          {&OceanParams::block(), &DecorationParams::block(), &OceanPaintParams::block(),
           &OceanMetaTextureParams::block(), &FloatParams::block(), &DrapeParams::block()},
          extraRules()};
}

}  // namespace scumble::ocean
