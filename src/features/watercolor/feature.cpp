// What the program knows of watercolours.
#include "features/watercolor/pigment/anchors_on_gpu.h"
#include "features/watercolor/watercolor.h"
#include "features/watercolor/watercolor_knobs.h"
#include "frame/feature_parts.h"
#include "look/anywhere.h"

namespace scumble::watercolor {

namespace {

class WatercolorPlan : public world::FeaturePlan {
 public:
  bool equals(const world::FeaturePlan&) const override { return true; }
  std::unique_ptr<world::FeatureMoment> makeMoment(gpu::Device& device,
                                                   const scene::SceneData& scene) const override {
    return std::make_unique<WatercolorMoment>(device, scene);
  }
};

class WatercolorFeature : public world::Feature {
 public:
  const char* name() const override { return kName; }
  std::string_view material() const override { return ""; }
  std::shared_ptr<const world::FeaturePlan> plan(const scene::SceneData&,
                                                 const look::LookData& look) const override {
    return mayShow(look) ? std::make_shared<WatercolorPlan>() : nullptr;
  }
  Switch onOff() const override {
    return {&WatercolorParams::block(), "shown",
            "the picture is no watercolour; --set watercolor.shown=on makes it one"};
  }
};

}  // namespace

bool mayColorStamps(const look::LookData& look) {
  return look::mayBeAboveZero(look, &StampParams::colorAmount);
}

frame::FeatureParts makeFeature() {
  return {std::make_unique<WatercolorFeature>(),
          {{"surface", makePigment}, {"lost-edges", makeExtent}, {"lost-edges", makeWash}},
          {&WatercolorParams::block(), &StampParams::block()},
          {}};
}

}  // namespace scumble::watercolor
