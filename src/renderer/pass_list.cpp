#include "renderer/pass_list.h"

#include <algorithm>
#include <string_view>

#include "frame/metatexture.h"
#include "passes/blur/blur.h"
#include "passes/color/color.h"
#include "passes/colorize/colorize.h"
#include "passes/deform/deform.h"
#include "passes/facts/facts.h"
#include "passes/final_color/final_color.h"
#include "passes/final_shadow/final_shadow.h"
#include "passes/limit/limit.h"
#include "passes/matte/matte.h"
#include "passes/ocean/ocean.h"
#include "passes/plain/plain.h"
#include "passes/shadow_map/shadow_map.h"
#include "passes/surface/surface.h"
#include "passes/warp/warp.h"
#include "stage/animation_params.h"
#include "stage/camera.h"
#include "stage/light.h"
#include "stage/palette.h"

namespace scumble {

namespace look {

const std::vector<const ParamBlock*>& allBlocks() {
  static const std::vector<const ParamBlock*> blocks{
      &stage::LightParams::block(),       &passes::ShadowMapParams::block(),
      &stage::PaletteParams::block(),     &stage::LitParams::block(),
      &stage::ShadowedParams::block(),    &passes::SurfaceParams::block(),
      &passes::BlurParams::block(),       &passes::FinalShadowParams::block(),
      &passes::TextureParams::block(),    &frame::TextureMetaTextureParams::block(),
      &passes::WarpParams::block(),       &frame::WarpMetaTextureParams::block(),
      &passes::BreakupParams::block(),    &frame::BreakupMetaTextureParams::block(),
      &passes::BackgroundParams::block(), &stage::GroundParams::block(),
      &passes::VolumeParams::block(),     &passes::GradeParams::block(),
      &passes::LimitParams::block(),      &passes::FinalColorParams::block(),
      &stage::AnimationParams::block(),   &stage::PlayParams::block(),
      &world::OceanParams::block(),       &world::DecorationParams::block(),
      &passes::OceanPaintParams::block(), &frame::OceanMetaTextureParams::block(),
      &world::FloatParams::block(),       &stage::CameraParams::block()};
  return blocks;
}

}  // namespace look

namespace renderer {

namespace {

// Whether anything may act on the lens at any time.
bool glows(const look::LookData& look, const scene::SceneData& scene) {
  const auto sets = [](const look::Assignment& a) {
    return a.block == &passes::SurfaceParams::block() && std::string_view(a.row->name) == "glow";
  };
  return std::any_of(look.assignments.begin(), look.assignments.end(), sets) ||
         std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const scene::Material& material) { return material.emissive != glm::vec3(0.0f); });
}

}  // namespace

float largestInflation(const look::LookData& look, const SceneOnGpu& scene, float imageHeight) {
  float most = 0;
  for (size_t m = 0; m < scene.materialCount(); ++m)
    most =
        std::max(most, scene.warpScaleOf(m) *
                           passes::inflationPixels(
                               look.getForMaterial<passes::WarpParams>(scene.materialName(m)), imageHeight));
  return most;
}

bool PassList::insertBefore(const std::string& name, Make make) {
  const auto found =
      std::find_if(makes_.begin(), makes_.end(), [&](const Make& other) { return name == other()->name(); });
  if (found == makes_.end()) return false;
  makes_.insert(found, std::move(make));
  return true;
}

bool PassList::insertAfter(const std::string& name, Make make) {
  const auto found = std::find_if(makes_.rbegin(), makes_.rend(),
                                  [&](const Make& other) { return name == other()->name(); });
  if (found == makes_.rend()) return false;
  makes_.insert(found.base(), std::move(make));
  return true;
}

std::vector<std::unique_ptr<Pass>> PassList::makeAll() const {
  std::vector<std::unique_ptr<Pass>> passes;
  for (const Make& make : makes_) passes.push_back(make());
  return passes;
}

PassList standardPasses() {
  PassList list;
  list.append(passes::makeDeform);
  list.append(passes::makeShadowMap);
  list.append(passes::makeWarp);
  list.append(passes::makeOcean);
  for (const Layer layer : kLayers) list.append([=] { return passes::makeSurface(layer); });
  list.append(passes::makeBlur);
  list.append([] {
    return passes::makeFinalShadow([](const look::LookData& look, float pixelScale) {
      const passes::BlurParams blur = look.get<passes::BlurParams>();
      return passes::BlurFacts{passes::planBlur(blur.radius * pixelScale).amount,
                               passes::depthSharpness(blur.depthEdge)};
    });
  });
  for (const Layer layer : kLayers)
    list.append([=] {
      return passes::makeColor(layer, [](const look::LookData& look) {
        const passes::FinalShadowParams shadow = look.get<passes::FinalShadowParams>();
        return passes::ShadowMix{shadow.glowColor, shadow.glowColorAmount, shadow.steps > 1};
      });
    });
  for (const Layer layer : kLayers) list.append([=] { return passes::makeColorize(layer); });
  for (const Layer layer : kLayers) list.append([=] { return passes::makeLimit(layer); });
  list.append([] { return passes::makeFinalColor({.inflation = largestInflation, .glow = glows}); });
  list.append(passes::makeFacts);
  list.append([] {
    return passes::makeMatte({
        .displacement =
            [](const look::LookData& look, const SceneOnGpu& scene, float imageHeight) {
              return shared::Displacement{largestInflation(look, scene, imageHeight)};
            },
        .ripple = [](const look::LookData& look) -> int {
          return look.get<passes::FinalColorParams>().ripple;
        },
        .simplify =
            [](const look::LookData& look, const SceneOnGpu& scene, size_t material) {
              return scene.knobs<passes::SurfaceParams>(look, material).simplify;
            },
    });
  });
  return list;
}

PassList plainPasses() {
  PassList list;
  list.append(passes::makeDeform);
  list.append(passes::makePlain);
  return list;
}

std::vector<const Aov*> aovsOf(const std::vector<std::unique_ptr<Pass>>& passes) {
  std::vector<const Aov*> aovs;
  for (const auto& pass : passes)
    for (const Aov& aov : pass->aovs())
      if (std::none_of(aovs.begin(), aovs.end(),
                       [&](const Aov* other) { return std::string_view(other->name) == aov.name; }))
        aovs.push_back(&aov);
  return aovs;
}

std::vector<bool> shadowCasters(const scene::SceneData& scene, const look::LookData& look) {
  std::vector<bool> casts;
  for (const scene::Material& material : scene.materials)
    casts.push_back(look.getForMaterial<passes::ShadowMapParams>(material.name).cast);
  return casts;
}

}  // namespace renderer
}  // namespace scumble
