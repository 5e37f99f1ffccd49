#include "renderer/pass_list.h"

#include <algorithm>
#include <string_view>

#include "frame/animation_params.h"
#include "frame/camera.h"
#include "frame/light.h"
#include "frame/metatexture.h"
#include "frame/palette.h"
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

namespace scumble {

namespace look {

const std::vector<const ParamBlock*>& allBlocks() {
  static const std::vector<const ParamBlock*> blocks{
      &frame::LightParams::block(),       &passes::ShadowMapParams::block(),
      &frame::PaletteParams::block(),     &frame::LitParams::block(),
      &frame::ShadowedParams::block(),    &passes::SurfaceParams::block(),
      &passes::BlurParams::block(),       &passes::FinalShadowParams::block(),
      &passes::TextureParams::block(),    &frame::TextureMetaTextureParams::block(),
      &passes::WarpParams::block(),       &frame::WarpMetaTextureParams::block(),
      &passes::BreakupParams::block(),    &frame::BreakupMetaTextureParams::block(),
      &passes::BackgroundParams::block(), &frame::GroundParams::block(),
      &passes::VolumeParams::block(),     &passes::GradeParams::block(),
      &passes::LimitParams::block(),      &passes::FinalColorParams::block(),
      &frame::AnimationParams::block(),   &frame::PlayParams::block(),
      &frame::OceanParams::block(),       &frame::DecorationParams::block(),
      &passes::OceanPaintParams::block(), &frame::OceanMetaTextureParams::block(),
      &frame::FloatParams::block(),       &frame::CameraParams::block()};
  return blocks;
}

}  // namespace look

namespace renderer {

std::vector<std::unique_ptr<Pass>> makePasses(const Configuration& configuration) {
  std::vector<std::unique_ptr<Pass>> list;
  list.push_back(passes::makeDeform());
  if (configuration.plain) {
    list.push_back(passes::makePlain());
    return list;
  }
  list.push_back(passes::makeShadowMap());
  list.push_back(passes::makeWarp());
  if (configuration.ocean) list.push_back(passes::makeOcean());
  list.push_back(passes::makeSurface(passes::SurfaceLayer::first));
  if (configuration.layered) list.push_back(passes::makeSurface(passes::SurfaceLayer::behind));
  list.push_back(passes::makeBlur());
  list.push_back(passes::makeFinalShadow([](const look::LookData& look, float pixelScale) {
    const passes::BlurParams blur = look.get<passes::BlurParams>();
    return passes::BlurFacts{passes::planBlur(blur.radius * pixelScale).amount,
                             passes::depthSharpness(blur.depthEdge)};
  }));
  list.push_back(passes::makeColor([](const look::LookData& look) {
    const passes::FinalShadowParams shadow = look.get<passes::FinalShadowParams>();
    return passes::ShadowMix{shadow.glowColor, shadow.glowColorAmount, shadow.steps > 1};
  }));
  if (configuration.colorize) list.push_back(passes::makeColorize());
  if (configuration.limit) list.push_back(passes::makeLimit());
  list.push_back(passes::makeFinalColor(largestInflation));
  if (configuration.facts) list.push_back(passes::makeFacts());
  if (configuration.matte)
    list.push_back(passes::makeMatte({
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
    }));
  return list;
}

float largestInflation(const look::LookData& look, const SceneOnGpu& scene, float imageHeight) {
  float most = 0;
  for (size_t m = 0; m < scene.materialCount(); ++m)
    most =
        std::max(most, scene.warpScaleOf(m) *
                           passes::inflationPixels(
                               look.getForMaterial<passes::WarpParams>(scene.materialName(m)), imageHeight));
  return most;
}

bool wantsLayers(const look::LookData& look) {
  return look.get<passes::FinalColorParams>().ripple == shared::kRippleLayered;
}

bool glows(const scene::SceneData& scene, const look::LookData& look) {
  const auto sets = [](const look::Assignment& a) {
    return a.block == &passes::SurfaceParams::block() && std::string_view(a.row->name) == "glow";
  };
  return std::any_of(look.assignments.begin(), look.assignments.end(), sets) ||
         std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const scene::Material& material) { return material.emissive != glm::vec3(0.0f); });
}

bool wantsLimit(const look::LookData& look) {
  return !passes::paletteColors(look.get<passes::LimitParams>()).empty();
}

bool wantsColorizers(const look::LookData& look) {
  return !look.declared(look::kColorizers).empty();
}

std::vector<bool> shadowCasters(const scene::SceneData& scene, const look::LookData& look) {
  std::vector<bool> casts;
  for (const scene::Material& material : scene.materials)
    casts.push_back(look.getForMaterial<passes::ShadowMapParams>(material.name).cast);
  return casts;
}

}  // namespace renderer
}  // namespace scumble
