#include "renderer/uniforms.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <span>

#include "passes/color/color_knobs.h"
#include "passes/surface/surface_knobs.h"
#include "passes/warp/warp_knobs.h"
#include "renderer/view_groups.h"
#include "shading/luminance.shared.h"
#include "stage/light.h"
#include "stage/palette.h"
#include "world/ground.h"

namespace scumble::renderer {

namespace {

// Of an off-centre projection, in normalised device coordinates: what is straight ahead lies at minus it.
// Clip x is P00 x + P02 z with z = -w: ndc = P00 (x / -z) - P02, so x / -z = (ndc + P02) / P00; parallel
// projections have their shift in the last column instead.
glm::vec2 shiftOf(const View& view) {
  const glm::mat4& p = view.eyeToClip;
  return isParallel(view) ? glm::vec2(-p[3][0], -p[3][1]) : glm::vec2(p[2][0], p[2][1]);
}

// Of a perspective view, straight ahead.
float pixelsOfRadian(const View& view, glm::uvec2 size) {
  return 0.5f * float(size.y) * std::abs(view.eyeToClip[1][1]);
}

}  // namespace

shared::ViewUniforms viewUniforms(const View& view, const View& previous) {
  const glm::mat4& p = view.eyeToClip;
  shared::ViewUniforms u{};
  u.worldToClip = p * view.worldToEye;
  u.worldToEye = view.worldToEye;
  u.previousWorldToClip = previous.eyeToClip * previous.worldToEye;
  u.upInEye = glm::vec3(view.worldToEye[1]);
  u.eye = glm::vec3(glm::inverse(view.worldToEye)[3]);
  u.orthographic = isParallel(view) ? 1.0f : 0.0f;
  const glm::vec2 shift = shiftOf(view);
  u.ndcToEyeRay = {1 / p[0][0], 1 / p[1][1], shift.x / p[0][0], shift.y / p[1][1]};
  // Depth value d = (A z + B) / w with z = -distance; w = distance, or 1.
  const float a = p[2][2], b = p[3][2];
  u.depthToEye = u.orthographic != 0 ? glm::vec4(b / a, -1 / a, 1, 0) : glm::vec4(b, 0, a, 1);
  return u;
}

float knobHeight(const View& view, glm::uvec2 size, const SpherePart* sphere) {
  return sphere ? pixelsOfRadian(view, size) * sphere->knobHeight : float(size.y);
}

glm::vec2 wholeSphere(const View& view, glm::uvec2 size) {
  return pixelsOfRadian(view, size) * glm::pi<float>() * glm::vec2(2, 1);
}

shared::FrameUniforms frameUniforms(const SceneOnGpu& scene, const KnobTable& knobs,
                                    const std::vector<View>& views, const std::vector<View>& previousViews,
                                    const std::vector<View>& rig, double time, glm::uvec2 size,
                                    const SpherePart* sphere) {
  shared::FrameUniforms u{};
  for (size_t i = 0; i < views.size(); ++i)
    u.views[i] = viewUniforms(views[i], previousViews.empty() ? views[i] : previousViews[i]);
  glm::vec3 viewer(0.0f);
  for (const View& view : rig) viewer += viewUniforms(view, view).eye / float(rig.size());
  u.time = float(time);
  u.imageSize = glm::vec2(size);
  u.knobHeight = knobHeight(rig.front(), size, sphere);
  u.pixelScale = u.knobHeight / 1080.0f;
  u.eyeToSphere = sphere ? sphere->eyeToSphere : glm::mat3(0.0f);
  u.sceneCenter = scene.bounds().center();
  u.sceneRadius = std::max(scene.bounds().radius(), 1e-6f);
  const View middle = middleOf(rig);
  const shared::ViewUniforms cyclopean = viewUniforms(middle, middle);
  for (size_t i = 0; i < views.size(); ++i)
    u.views[i].aside = 0.5f * u.imageSize * (shiftOf(middle) - shiftOf(views[i]));
  u.worldToCyclopean = cyclopean.worldToClip;
  u.cyclopeanNdcToEyeRay = cyclopean.ndcToEyeRay;

  const LightParams light = knobs.scene<LightParams>();
  u.toLight = keyLightDirection(scene.data(), light, scene.motion().world(), scene.motion().shown());
  u.viewer = viewer;
  setLightSpace(u, scene.casters(), light, viewer);
  return u;
}

shared::ColorMap ColorMaps::get(const ColorRule& rule) {
  if (rule.side == ColorRule::painted && rule.grade == Grade()) return identityColorMap();
  // To the bit.
  const auto bytes = [](const ColorRule& of) { return std::as_bytes(std::span(&of, 1)); };
  for (const auto& [known, map] : known_)
    if (std::ranges::equal(bytes(known), bytes(rule))) return map;
  // An animated palette must not fill the memory.
  if (known_.size() >= 256) known_.clear();
  return known_.emplace_back(rule, fitColorMap(rule)).second;
}

namespace {

void setTransform(const scene::TextureUse& use, glm::vec3& rowU, glm::vec3& rowV, uint32_t& set) {
  const glm::mat3 rows = glm::transpose(use.transform);
  rowU = rows[0], rowV = rows[1];
  set = uint32_t(use.uvSet);
}

// Without what the rule does to colours in light: those have been chosen.
PaletteParams ofChosenLight(PaletteParams palette) {
  palette.darkest = 0, palette.lightest = 1, palette.litTintAmount = 0;
  return palette;
}

}  // namespace

ChosenSets chosenSets(const SceneOnGpu& scene, size_t index, const KnobTable& knobs, LookTextures& textures) {
  // A texture for all of a scene is not meant for the quiet ground under it.
  if (scene.groundTone(index) >= 0) return {};
  const scene::Material& material = scene.material(index);
  const auto choose = [&](look::Picture picture, const scene::TextureUse& own) -> std::optional<SetTexture> {
    if (picture.index < 0) return textures.get(knobs.look(), picture);
    if (picture.index == kSetOfScene && own.image >= 0) return scene.textureOf(own);
    return std::nullopt;
  };
  return {choose(knobs.of<LitParams>(index).texture, material.litTexture),
          choose(knobs.of<ShadowedParams>(index).texture, material.shadowedTexture)};
}

namespace {

// The sky is cooler than the colour in shadow, the ground warmer, at about equal brightness. Factors.
glm::vec3 tintUp(float skyTint) {
  return 1.0f + skyTint * glm::vec3(0.0f, 0.7f, 1.6f);
}
glm::vec3 tintDown(float skyTint) {
  return glm::max(1.0f + skyTint * glm::vec3(0.6f, -0.4f, -1.2f), 0.0f);
}

}  // namespace

shared::Backdrop backdropUniforms(const SceneOnGpu& scene, const KnobTable& knobs,
                                  const shared::FrameUniforms& frame, const glm::uvec2& texels,
                                  const glm::vec2& sphere, ColorMaps& maps) {
  const passes::BackgroundParams params = knobs.scene<passes::BackgroundParams>();
  const int ground = scene.groundMaterial();
  const PaletteParams palette =
      ground < 0 ? knobs.scene<PaletteParams>() : knobs.of<PaletteParams>(size_t(ground));
  shared::Backdrop b{};
  // Covering the frame: the same texels per pixel both ways. Or all around.
  const bool onSphere = sphere != glm::vec2(0);
  const glm::vec2 whole = onSphere ? sphere : frame.imageSize;
  const glm::vec2 ratio = glm::vec2(texels) / whole;
  const float density = std::min(ratio.x, ratio.y);
  b.scale = onSphere ? frame.imageSize / whole : density / ratio;
  b.minified = std::clamp(2.0f * (density - 1.0f), 0.0f, 1.0f);
  b.radius = params.simplify * frame.pixelScale;
  b.sectorLevel = std::max(0.0f, std::log2(0.8f * b.radius * density));
  b.steps = float(params.steps);
  b.style = params.style;
  b.warp = params.warp;
  b.tear = knobs.scene<passes::WarpParams>().amount * frame.pixelScale;
  b.groundHeight = groundHeight(scene.bounds());
  // Long before the disc of the ground ends.
  const float center = glm::length(frame.sceneCenter - frame.viewer);
  b.matteNear = center + 10 * frame.sceneRadius;
  b.matteFar = center + 30 * frame.sceneRadius;
  b.shadowTint = tintUp(palette.skyTint);
  b.lit = maps.get({ColorRule::lit, palette});
  b.litShadowed = maps.get({ColorRule::shadowed, palette});
  b.shadowed = maps.get({ColorRule::shadowed, ofChosenLight(palette)});
  return b;
}

float largestInflation(const SceneOnGpu& scene, const KnobTable& knobs, float height) {
  float most = 0;
  for (size_t m = 0; m < scene.materialCount(); ++m)
    most = std::max(most,
                    scene.warpScaleOf(m) * passes::inflationPixels(knobs.of<passes::WarpParams>(m), height));
  return most;
}

shared::MaterialData materialData(const SceneOnGpu& scene, size_t index, const KnobTable& knobs,
                                  bool overPicture, ColorMaps& maps) {
  const int tone = scene.groundTone(index);
  const scene::Material& material = scene.material(index);
  const PaletteParams palette = knobs.of<PaletteParams>(index);
  const uint8_t sets = scene.colorSets(index);
  shared::MaterialData data{};
  data.baseColor = material.baseColor;
  data.emissive = material.emissive;
  data.alphaCutoff = material.alphaCutoff;
  data.unlit = material.unlit ? 1.0f : 0.0f;
  setTransform(material.baseColorTexture, data.baseUvRowU, data.baseUvRowV, data.baseUvSet);
  setTransform(material.emissiveTexture, data.emissiveUvRowU, data.emissiveUvRowV, data.emissiveUvSet);

  data.tintUp = glm::sqrt(tintUp(palette.skyTint));
  data.tintDown = glm::sqrt(tintDown(palette.skyTint));

  // Where both colours come from.
  const Grade litGrade = Grade::of(knobs.of<LitParams>(index)),
              shadowedGrade = Grade::of(knobs.of<ShadowedParams>(index));
  const bool derivesShadow = knobs.of<ShadowedParams>(index).texture.index == kSetDerived;
  ColorRule lit{ColorRule::lit, palette, litGrade}, shadowed{ColorRule::shadowed, palette, shadowedGrade};
  const ColorRule painted{ColorRule::painted, {}, litGrade};
  glm::dvec3 base = glm::clamp(glm::dvec3(material.baseColor), 0.0, 1.0);
  if (tone >= 0) {
    // The ground belongs to the background, not to the scene's palette.
    const GroundParams params = knobs.scene<GroundParams>();
    const glm::vec3 own = knobs.scene<passes::BackgroundParams>().mode == 0
                              ? automaticBackground(scene.colors()).ground
                              : glm::vec3(params.tint);
    const glm::vec3 ground = own * glm::pow(groundTone(tone, params.strokes), glm::vec3(2.0f));
    data.baseColor = glm::vec4(ground, 1.0f);
    base = glm::dvec3(ground);
    lit = painted;
    shadowed.palette = ofChosenLight(palette);
    data.matte = overPicture ? 1.0f : 0.0f;
  } else if (sets & kLitSet) {
    lit = painted;
    shadowed.palette = ofChosenLight(palette);
    shadowed.palette.saturation = 1;
  }
  const bool hasOwnColor = material.shadowedColor && !derivesShadow && !(sets & kShadowedSet);
  if (hasOwnColor || (sets & kShadowedSet)) {
    // A scene that brings its own colours for shadow has chosen those for light as well.
    data.hasShadowedColor = palette.ownShadow;
    if (hasOwnColor) data.shadowedColor = graded(shadowedGrade, glm::dvec3(*material.shadowedColor));
    if (palette.ownShadow >= 1) lit = painted;
  }
  // What is unlit is to look as its author painted it.
  if (material.unlit) lit = painted;
  // Planes are the rule's; what somebody has chosen stays as it is.
  const bool hasPlanes = lit.side == ColorRule::lit && material.emissive == glm::vec3(0.0f);
  const PlaneTints planes = planeTints(hasPlanes ? palette.planes : 0, scene.colors());
  data.planeSky = glm::sqrt(planes.sky);
  data.planeTurned = glm::sqrt(planes.turned);

  const bool isPainted = knobs.of<passes::TextureParams>(index).amount > 0;
  data.lit = identityColorMap();
  if (scene.isVaried(index) || isPainted || sets) {
    data.lit = maps.get(lit);
    data.shadowed = maps.get(shadowed);
    if (sets & kShadowedSet) data.ownShadowed = maps.get({ColorRule::painted, {}, shadowedGrade});
  }

  // A constant colour needs no fit: it goes through the rule itself.
  glm::vec3 constantLit(lit(base));
  glm::vec3 dark(shadowed(base));
  if (hasOwnColor) dark = glm::mix(dark, data.shadowedColor, palette.ownShadow);
  data.blacks = palette.blacks * palette.blacks * palette.blacks;
  constantLit = glm::mix(constantLit, dark,
                         shared::blackness(glm::dot(glm::vec3(base), shared::kLuminance), data.blacks));
  if (material.unlit) dark = constantLit;
  const glm::vec3 down = material.unlit ? glm::vec3(1.0f) : data.tintDown;
  const glm::vec3 up = material.unlit ? glm::vec3(1.0f) : data.tintUp;
  data.constantLit = glm::sqrt(constantLit + material.emissive);
  data.constantShadowedDown = glm::sqrt(dark * down * down + material.emissive);
  data.constantShadowedUp = glm::sqrt(dark * up * up + material.emissive);
  data.constantLens = glm::dot(material.emissive, shared::kLuminance);
  return data;
}

}  // namespace scumble::renderer
