// What the program knows of paintings in space.
#include <algorithm>

#include "features/painting/painting.h"
#include "features/painting/painting_knobs.h"
#include "features/painting/splats/strokes_on_gpu.h"
#include "frame/feature_parts.h"

namespace scumble::painting {

namespace {

class PaintingFeature : public world::Feature {
 public:
  const char* name() const override { return kName; }
  std::string_view material() const override { return ""; }
  std::shared_ptr<const world::FeaturePlan> plan(const scene::SceneData& scene,
                                                 const look::LookData& look) const override {
    return mayShow(scene, look) ? std::make_shared<PaintingPlan>(paintingsOf(scene)) : nullptr;
  }
  Switch onOff() const override {
    return {&PaintingParams::block(), "shown",
            "the scene has no strokes in space, or the look does not show them (painting.shown)"};
  }
};

}  // namespace

bool mayShow(const scene::SceneData& scene, const look::LookData& look) {
  if (!look.get<PaintingParams>().shown) return false;
  const std::vector<bool> shown = scene::shownNodes(scene);
  for (size_t n = 0; n < scene.nodes.size(); ++n)
    if (const int mesh = scene.nodes[n].mesh; mesh >= 0 && shown[n])
      if (const auto& painting = scene.meshes[size_t(mesh)]->painting; painting && !painting->strokes.empty())
        return true;
  return false;
}

frame::FeatureParts makeFeature() {
  return {std::make_unique<PaintingFeature>(),
          {{"surface", makeSplats}, {"final-color", makeOver}},
          {&PaintingParams::block()},
          {}};
}

}  // namespace scumble::painting
