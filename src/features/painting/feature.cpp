// What the program knows of paintings in space.
#include <algorithm>
#include <bit>

#include "features/painting/painting.h"
#include "features/painting/painting_knobs.h"
#include "features/painting/strokes_on_gpu.h"
#include "frame/feature_parts.h"

namespace scumble::painting {

namespace {

class PaintingFeature : public world::Feature {
 public:
  const char* name() const override { return kName; }
  std::string_view material() const override { return ""; }
  std::shared_ptr<const world::FeaturePlan> plan(const scene::SceneData& scene,
                                                 const look::LookData& look) const override {
    return drawnPaintings(scene, look) ? std::make_shared<PaintingPlan>(paintingsOf(scene)) : nullptr;
  }
  Switch onOff() const override {
    return {&PaintingParams::block(), "shown",
            "the scene has no strokes in space, or the look does not show them (painting.shown)"};
  }
};

}  // namespace

uint32_t drawnPaintings(const scene::SceneData& scene, const look::LookData& look) {
  if (!look.get<PaintingParams>().shown) return 0;
  const bool any = std::any_of(scene.meshes.begin(), scene.meshes.end(),
                               [](const scene::Mesh& mesh) { return bool(mesh.painting); });
  const uint32_t paintings = any ? uint32_t(paintingsOf(scene).size()) : 0;
  return paintings ? std::bit_ceil(paintings) : 0;
}

bool showsLayers(const scene::SceneData& scene, const look::LookData& look) {
  return look.get<PaintingParams>().shown &&
         std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const scene::Material& material) { return material.paint.has_value(); });
}

frame::FeatureParts makeFeature() {
  return {std::make_unique<PaintingFeature>(),
          {{"order", makePoints}, {"surface", makeSplats}, {"lost-edges", makeOver, {"watercolor"}}},
          {&PaintingParams::block()},
          {}};
}

}  // namespace scumble::painting
