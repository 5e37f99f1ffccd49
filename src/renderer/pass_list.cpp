#include "renderer/pass_list.h"

#include <algorithm>

#include "frame/animation_params.h"
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
#include "passes/plain/plain.h"
#include "passes/shadow_map/shadow_map.h"
#include "passes/surface/surface.h"
#include "passes/warp/warp.h"

namespace scumble {

namespace look {

const std::vector<const ParamBlock*>& allBlocks() {
  static const std::vector<const ParamBlock*> blocks{
      &frame::LightParams::block(),       &passes::ShadowMapParams::block(),
      &frame::PaletteParams::block(),     &passes::SurfaceParams::block(),
      &passes::BlurParams::block(),       &passes::FinalShadowParams::block(),
      &passes::TextureParams::block(),    &frame::TextureMetaTextureParams::block(),
      &passes::WarpParams::block(),       &frame::WarpMetaTextureParams::block(),
      &passes::BreakupParams::block(),    &frame::BreakupMetaTextureParams::block(),
      &passes::BackgroundParams::block(), &frame::GroundParams::block(),
      &passes::VolumeParams::block(),     &passes::GradeParams::block(),
      &passes::FinalColorParams::block(), &frame::AnimationParams::block(),
      &frame::PlayParams::block()};
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
  list.push_back(passes::makeSurface(passes::SurfaceLayer::first));
  if (configuration.layered) list.push_back(passes::makeSurface(passes::SurfaceLayer::behind));
  list.push_back(passes::makeBlur());
  list.push_back(passes::makeFinalShadow([](const look::LookData& look, float pixelScale) {
    const passes::BlurParams blur = look.get<passes::BlurParams>();
    return passes::BlurFacts{passes::planBlur(blur.radius * pixelScale).amount,
                             passes::depthSharpness(blur.depthEdge)};
  }));
  list.push_back(passes::makeColor());
  if (configuration.colorize) list.push_back(passes::makeColorize());
  list.push_back(passes::makeFinalColor(largestInflation));
  if (configuration.facts) list.push_back(passes::makeFacts());
  return list;
}

float largestInflation(const look::LookData& look, const SceneOnGpu& scene, float imageHeight) {
  float most = 0;
  for (size_t m = 0; m < scene.materialCount(); ++m)
    most = std::max(most, passes::inflationPixels(
                              look.getForMaterial<passes::WarpParams>(scene.materialName(m)), imageHeight));
  return most;
}

bool wantsLayers(const look::LookData& look) {
  return look.get<passes::FinalColorParams>().ripple == passes::kRippleLayered;
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
