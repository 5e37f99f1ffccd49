// What the program knows of watercolours.
#include <algorithm>

#include "features/watercolor/pigment/anchors_on_gpu.h"
#include "features/watercolor/watercolor.h"
#include "features/watercolor/watercolor_knobs.h"
#include "frame/feature_parts.h"

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
  const auto colors = [](const look::Assignment& a) {
    return a.block == &StampParams::block() && std::string_view(a.row->name) == "colorAmount" &&
           !a.pattern.empty() && a.value.number > 0;
  };
  return look.get<StampParams>().colorAmount > 0 ||
         std::any_of(look.assignments.begin(), look.assignments.end(), colors);
}

frame::FeatureParts makeFeature() {
  return {std::make_unique<WatercolorFeature>(),
          {{"surface", makePigment}, {"lost-edges", makeExtent}, {"lost-edges", makeWash}},
          {&WatercolorParams::block(), &StampParams::block()},
          {}};
}

}  // namespace scumble::watercolor
