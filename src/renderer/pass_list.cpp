#include "renderer/pass_list.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string_view>

#include "frame/metatexture.h"
#include "passes/bloom/bloom.h"
#include "passes/blur/blur.h"
#include "passes/blur/blur_knobs.h"
#include "passes/color/color.h"
#include "passes/color/color_knobs.h"
#include "passes/colorize/colorize.h"
#include "passes/colorize/colorize_knobs.h"
#include "passes/cull/cull.h"
#include "passes/cull/cull_knobs.h"
#include "passes/deform/deform.h"
#include "passes/facts/facts.h"
#include "passes/final_color/final_color.h"
#include "passes/final_color/final_color_knobs.h"
#include "passes/final_shadow/final_shadow.h"
#include "passes/final_shadow/final_shadow_knobs.h"
#include "passes/limit/limit.h"
#include "passes/limit/limit_knobs.h"
#include "passes/lost_edges/lost_edges.h"
#include "passes/matte/matte.h"
#include "passes/order/order.h"
#include "passes/plain/plain.h"
#include "passes/shadow_map/shadow_map.h"
#include "passes/shadow_map/shadow_map_knobs.h"
#include "passes/surface/surface.h"
#include "passes/surface/surface_knobs.h"
#include "passes/tiles/tiles.h"
#include "passes/warp/warp.h"
#include "passes/warp/warp_knobs.h"
#include "renderer/feature_list.h"
#include "stage/animation_params.h"
#include "stage/camera.h"
#include "stage/light.h"
#include "stage/palette.h"

namespace scumble {

namespace look {

const std::vector<const ParamBlock*>& ownBlocks() {
  static const std::vector<const ParamBlock*> blocks = [] {
    std::vector<const ParamBlock*> all{&stage::LightParams::block(),
                                       &passes::ShadowMapParams::block(),
                                       &stage::PaletteParams::block(),
                                       &stage::LitParams::block(),
                                       &stage::ShadowedParams::block(),
                                       &passes::SurfaceParams::block(),
                                       &passes::BlurParams::block(),
                                       &passes::FinalShadowParams::block(),
                                       &passes::IndirectParams::block(),
                                       &passes::TextureParams::block(),
                                       &frame::TextureMetaTextureParams::block(),
                                       &passes::WarpParams::block(),
                                       &frame::WarpMetaTextureParams::block(),
                                       &passes::BreakupParams::block(),
                                       &frame::BreakupMetaTextureParams::block(),
                                       &passes::BackgroundParams::block(),
                                       &stage::GroundParams::block(),
                                       &passes::VolumeParams::block(),
                                       &passes::GradeParams::block(),
                                       &passes::LimitParams::block(),
                                       &passes::FinalColorParams::block(),
                                       &passes::LevelsParams::block(),
                                       &stage::AnimationParams::block(),
                                       &stage::PlayParams::block()};
    for (const frame::FeatureParts& parts : renderer::features())
      all.insert(all.end(), parts.blocks.begin(), parts.blocks.end());
    all.push_back(&stage::CameraParams::block());
    return all;
  }();
  return blocks;
}

}  // namespace look

namespace renderer {

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

bool PassList::has(const std::string& name) const {
  return std::any_of(makes_.begin(), makes_.end(), [&](const Make& make) { return name == make()->name(); });
}

std::vector<std::unique_ptr<Pass>> PassList::makeAll() const {
  std::vector<std::unique_ptr<Pass>> passes;
  for (const Make& make : makes_) passes.push_back(make());
  return passes;
}

std::vector<FeaturePass> inOrder(std::vector<FeaturePass> passes,
                                 const std::vector<std::string>& knownFeatures) {
  const auto isKnown = [&](std::string_view name) {
    return std::find(knownFeatures.begin(), knownFeatures.end(), name) != knownFeatures.end();
  };
  std::stable_sort(passes.begin(), passes.end(),
                   [](const FeaturePass& a, const FeaturePass& b) { return a.feature < b.feature; });
  std::vector<FeaturePass> ordered;
  while (!passes.empty()) {
    // The first one that none of the others has to come before.
    const auto isFree = [&](const FeaturePass& one) {
      return std::none_of(one.pass.above.begin(), one.pass.above.end(), [&](std::string_view below) {
        if (!isKnown(below))
          throw std::logic_error("a pass of the feature " + one.feature + " is to be above '" +
                                 std::string(below) + "', which is no feature");
        return std::any_of(passes.begin(), passes.end(),
                           [&](const FeaturePass& other) { return other.feature == below; });
      });
    };
    const auto next = std::find_if(passes.begin(), passes.end(), isFree);
    if (next == passes.end())
      throw std::logic_error("passes of " + passes.front().feature +
                             " and other features want to be above each other");
    ordered.push_back(*next);
    passes.erase(next);
  }
  return ordered;
}

namespace {

// Folders of all features, also of those that are not built.
const std::vector<std::string>& knownFeatures() {
  static const std::vector<std::string> names{
#define FEATURE(name) #name,
#include "all_feature_names.inc"
#undef FEATURE
  };
  return names;
}

// Passes of features, where what they come after is in the list.
void addFeatures(PassList& list) {
  std::map<std::string, std::vector<FeaturePass>> byPlace;
  for (const FeatureParts& parts : features())
    for (const FeatureParts::PlacedPass& pass : parts.passes)
      byPlace[pass.after].push_back({parts.feature->name(), pass});
  for (const auto& [place, passes] : byPlace) {
    const std::vector<FeaturePass> ordered = inOrder(passes, knownFeatures());
    // Each directly behind that place: the last one first.
    for (auto pass = ordered.rbegin(); pass != ordered.rend(); ++pass)
      list.insertAfter(place, pass->pass.make);
  }
}

PassList standardPassesAlone() {
  PassList list;
  list.append(passes::makeDeform);
  list.append(passes::makeCull);
  list.append(passes::makeOrder);
  list.append(passes::makeShadowMap);
  for (const Layer layer : kLayers) list.append([=] { return passes::makeSurface(layer); });
  list.append(passes::makeTiles);
  list.append(passes::makeWarp);
  list.append(passes::makeBlur);
  list.append(passes::makeBloom);
  list.append(passes::makeFinalShadow);
  for (const Layer layer : kLayers) list.append([=] { return passes::makeColor(layer); });
  for (const Layer layer : kLayers) list.append([=] { return passes::makeColorize(layer); });
  for (const Layer layer : kLayers) list.append([=] { return passes::makeLimit(layer); });
  for (const Layer layer : kOverlays) {
    list.append([=] { return passes::makeColorizeOverlay(layer); });
    list.append([=] { return passes::makeLimitOverlay(layer); });
  }
  list.append(passes::makeFinalColor);
  list.append(passes::makeLostEdges);
  list.append(passes::makeFacts);
  list.append(passes::makeMatte);
  return list;
}

}  // namespace

PassList standardPasses() {
  PassList list = standardPassesAlone();
  // A place that nobody knows is a mistake; the yardstick's list lacks some that are known.
  for (const FeatureParts& parts : features())
    for (const FeatureParts::PlacedPass& pass : parts.passes)
      if (!list.has(pass.after))
        throw std::logic_error(std::string("a pass of the feature ") + parts.feature->name() +
                               " is to come after '" + pass.after + "', which is no pass");
  addFeatures(list);
  return list;
}

PassList plainPasses() {
  PassList list;
  list.append(passes::makeDeform);
  list.append(passes::makeCullOfWholes);
  list.append(passes::makeOrder);
  list.append(passes::makePlain);
  addFeatures(list);
  return list;
}

std::vector<const Aov*> aovsOf(const std::vector<std::unique_ptr<Pass>>& passes) {
  std::vector<const Aov*> aovs;
  for (const auto& pass : passes)
    for (const Aov& aov : pass->aovs())
      if (std::none_of(aovs.begin(), aovs.end(),
                       [&](const Aov* other) { return std::string_view(other->name) == aov.name; }) &&
          !aov.isInternal)
        aovs.push_back(&aov);
  return aovs;
}

}  // namespace renderer
}  // namespace scumble
