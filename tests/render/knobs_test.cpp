// The test sweep: every knob at its least and at its most, on a tiny picture that shows light, shadow, edges,
// texture, holes, glow, motion and a sea. Nothing may fail, nothing may be infinite, and every knob must
// show: a knob that the sweep turns where it does nothing is not tested by it.
#include <cmath>
#include <map>
#include <set>

#include "tests/support/aov.h"
#include "tests/support/render_test.h"
#include "tests/support/sanitized.h"

namespace scumble {
namespace {

using namespace test;

constexpr uint32_t kWidth = 32, kHeight = 24;
constexpr double kTime = 0.8;  // seconds: nothing is where it was at 0

// Where a knob is set for all that it may be set for; colorizers and decorations are declared by their name.
std::string settingPath(const Knob& knob) {
  // The scene's counts for joints and morphs alone.
  if (knob.path == "animation.hold") return "nodes.*." + knob.path;
  const std::string& target = knob.targets[0];
  return (target == "scene"                                   ? ""
          : target == "colorizers" || target == "decorations" ? target + ".A."
                                                              : target + ".*.") +
         knob.path;
}

// What a knob needs to show, by the beginning of its path; all that fit are set, before the knob itself.
const std::pair<std::string, Knobs> kNeeds[] = {
    {"animation.", {{"clips.*.play.weight", "1"}}},
    {"background.", {{"background.mode", "look"}, {"ground.mode", "off"}}},
    {"background.air", {{"background.airStart", "0"}, {"background.airEnd", "0.5"}}},
    {"background.airEnd", {{"background.air", "1"}, {"background.airStart", "0"}}},
    {"background.sky", {{"background.skyTones", "4"}, {"background.skyStrokes", "2"}}},
    {"blur.depthEdge", {{"blur.radius", "128"}}},
    {"breakup.",
     {{"blur.radius", "128"}, {"shadow.indication", "1"}, {"shadow.dither", "1"}, {"breakup.amount", "4"}}},
    {"breakup.metatexture.", {{"breakup.metatexture.size", "1000"}}},
    {"breakup.metatexture.skewLevels", {{"breakup.metatexture.skew", "exact"}}},
    {"breakup.metatexture.tiles", {{"breakup.metatexture.mode", "object"}}},
    {"final.", {{"materials.*.surface.glow", "1"}}},
    {"final.lost", {{"warp.amount", "64"}, {"warp.inflation", "64"}, {"final.lostWidth", "48"}}},
    {"final.lostEdges", {{"final.lostValues", "1"}}},
    {"final.lostWidth", {{"final.lostValues", "1"}}},
    {"drape.",
     {{"ocean.mode", "on"}, {"ocean.grid", "8"}, {"ocean.tiles", "3"}, {"materials.*.drape.mode", "on"}}},
    {"float.",
     {{"ocean.mode", "on"}, {"ocean.grid", "8"}, {"ocean.tiles", "3"}, {"nodes.*.float.rides", "true"}}},
    {"grade.", {{"colorizers.A.grade.gain", "2"}}},
    {"grade.tint", {{"colorizers.A.volume.shape", "scene"}}},
    {"grade.gamma", {{"colorizers.A.grade.gain", "0.7"}}},
    {"ground.strokes", {{"ground.mode", "on"}, {"background.mode", "look"}}},
    {"ground.tint", {{"ground.mode", "on"}, {"background.mode", "look"}}},
    {"ink.", {{"ink.shown", "on"}, {"ink.greatest", "200"}, {"ink.least", "100"}}},
    {"ink.hidden", {{"ink.hidden", "1"}, {"ink.least", "20"}, {"ink.greatest", "20"}}},
    {"indirect.", {{"surface.occlusion", "1"}, {"surface.bounce", "1"}, {"indirect.reach", "1"}}},
    {"ink.boundaries.color", {{"ink.boundaries.color", "#FF2020"}, {"ink.boundaries.colorAmount", "1"}}},
    {"ink.creases.color", {{"ink.creases.color", "#FF2020"}, {"ink.creases.colorAmount", "1"}}},
    {"ink.breaks", {{"ink.least", "1"}, {"ink.greatest", "1"}}},
    {"ink.cutouts.", {{"ink.cutouts.shown", "on"}, {"ink.greatest", "40"}, {"ink.least", "20"}}},
    {"ink.cutouts.color", {{"ink.cutouts.color", "#FF2020"}, {"ink.cutouts.colorAmount", "1"}}},
    {"ink.cyclopean", {{"ink.placement", "centred"}}},
    {"ink.doubledWidth", {{"ink.doubled", "40"}}},
    {"ink.intersections.", {{"ink.intersections.shown", "on"}}},
    {"ink.intersections.color",
     {{"ink.intersections.color", "#FF2020"}, {"ink.intersections.colorAmount", "1"}}},
    {"ink.objects.", {{"ink.objects.shown", "on"}}},
    {"ink.objects.color", {{"ink.objects.color", "#FF2020"}, {"ink.objects.colorAmount", "1"}}},
    {"ink.shadows.", {{"ink.shadows.shown", "on"}, {"blur.radius", "128"}}},
    {"ink.shadows.color", {{"ink.shadows.color", "#FF2020"}, {"ink.shadows.colorAmount", "1"}}},
    {"ink.silhouettes.color", {{"ink.silhouettes.color", "#FF2020"}, {"ink.silhouettes.colorAmount", "1"}}},
    {"ink.smoothAngle", {{"ink.weights", "hybrid"}}},
    {"ink.steps.", {{"ink.steps.shown", "on"}, {"shadow.steps", "3"}, {"blur.radius", "64"}}},
    {"ink.steps.color", {{"ink.steps.color", "#FF2020"}, {"ink.steps.colorAmount", "1"}}},
    {"ink.textureAmount", {{"ink.texture", "pencil"}}},
    {"ink.textureSize", {{"ink.texture", "pencil"}}},
    {"ink.warp", {{"warp.amount", "64"}, {"warp.inflation", "64"}}},
    {"light.azimuth", {{"light.source", "look"}}},
    {"light.elevation", {{"light.source", "look"}}},
    {"limit.", {{"limit.palette", "look"}, {"limit.colors", "16"}, {"background.mode", "look"}}},
    {"limit.color11", {{"background.horizon", "#2E6474"}}},
    {"limit.color15", {{"background.horizon", "#14202E"}}},
    {"limit.color16", {{"background.horizon", "#FFF6E4"}}},
    {"limit.color2", {{"background.horizon", "#1F3A52"}}},
    {"lit.overlay", {{"lit.overlayAmount", "1"}}},
    {"ocean.", {{"ocean.mode", "on"}, {"ocean.grid", "8"}, {"ocean.tiles", "3"}}},
    {"ocean.heading", {{"ocean.speed", "3"}}},
    {"ocean.metatexture.",
     {{"ocean.paint.dither", "2"}, {"ocean.paint.lightDither", "2"}, {"ocean.metatexture.size", "1000"}}},
    {"ocean.metatexture.skewLevels", {{"ocean.metatexture.skew", "exact"}}},
    {"ocean.metatexture.tiles", {{"ocean.metatexture.mode", "object"}}},
    {"ocean.paint.foam",
     {{"ocean.choppiness", "2"},
      {"ocean.wind", "25"},
      {"ocean.paint.foamStart", "1"},
      {"ocean.paint.foam", "1"}}},
    {"ocean.paint.next", {{"ocean.paint.next", "0.5"}, {"ocean.paint.nextColors", "storm"}}},
    {"ocean.paint.nextSky", {{"ocean.paint.reflection", "4"}, {"ocean.paint.sky", "storm"}}},
    {"ocean.paint.overlay", {{"ocean.paint.overlayAmount", "1"}}},
    {"ocean.paint.skyOverlay", {{"ocean.paint.skyOverlayAmount", "1"}, {"ocean.paint.reflection", "4"}}},
    {"palette.litTint", {{"palette.litTintAmount", "2"}}},
    {"palette.shadowTint", {{"palette.shadowTintAmount", "2"}}},
    {"play.", {{"clips.*.play.weight", "1"}}},
    {"play.repeat", {{"clips.*.play.start", "2.5"}}},
    {"sample.", {{"sample.shown", "on"}}},
    {"shadow.glow", {{"shadow.innerGlow", "1"}, {"shadow.glowColorAmount", "1"}}},
    {"shadow.indicationSteps",
     {{"shadow.softness", "0.25"}, {"blur.radius", "20"}, {"shadow.threshold", "0.8"}}},
    {"shadow.indication",
     {{"blur.radius", "128"},
      {"shadow.indication", "1"},
      {"breakup.amount", "4"},
      {"surface.indicationWidth", "1"},
      {"breakup.metatexture.size", "1000"}}},
    {"final.ripple", {{"warp.amount", "64"}, {"warp.inflation", "64"}}},
    {"shadow.dither", {{"blur.radius", "128"}, {"breakup.amount", "4"}}},
    {"shadow.stepSpacing", {{"shadow.steps", "3"}}},
    {"shadowed.overlay", {{"shadowed.overlayAmount", "1"}}},
    {"surface.glow", {{"final.bloom", "4"}}},
    {"surface.occlusion", {{"indirect.reach", "1"}}},
    {"surface.bounce", {{"indirect.reach", "1"}}},
    {"surface.highlight",
     {{"final.bloom", "4"}, {"surface.highlight", "4"}, {"surface.highlightSize", "10"}}},
    {"surface.indication", {{"blur.radius", "128"}, {"shadow.indication", "1"}, {"breakup.amount", "4"}}},
    {"surface.lens", {{"final.bloom", "4"}}},
    {"texture.", {{"texture.amount", "1"}}},
    {"texture.metatexture.skewLevels", {{"texture.metatexture.skew", "exact"}}},
    {"texture.metatexture.tiles", {{"texture.metatexture.mode", "object"}}},
    {"watercolor.",
     {{"watercolor.shown", "on"}, {"watercolor.margin", "0"}, {"watercolor.paperSize", "1000"}}},
    {"watercolor.backruns", {{"watercolor.turbulence", "4"}}},
    {"watercolor.bareFrom", {{"watercolor.bare", "1"}}},
    {"watercolor.brush", {{"watercolor.turbulence", "4"}, {"watercolor.spacing", "400"}}},
    {"watercolor.brush2", {{"watercolor.brushes", "4"}}},
    {"watercolor.brush3", {{"watercolor.brushes", "4"}}},
    {"watercolor.brush4", {{"watercolor.brushes", "4"}}},
    {"watercolor.edgeWidth", {{"watercolor.edges", "8"}, {"watercolor.bleeding", "1"}}},
    {"watercolor.generator", {{"watercolor.turbulence", "4"}, {"watercolor.spacing", "400"}}},
    {"watercolor.lightDepth", {{"watercolor.relief", "4"}}},
    {"watercolor.lightRange", {{"watercolor.relief", "4"}}},
    {"watercolor.margin", {{"watercolor.strength", "4"}}},
    {"watercolor.sizes", {{"watercolor.turbulence", "4"}, {"watercolor.spacing", "400"}}},
    {"watercolor.stamps.", {{"watercolor.turbulence", "4"}, {"watercolor.spacing", "400"}}},
    {"watercolor.stamps.color", {{"watercolor.stamps.colorAmount", "1"}}},
    {"watercolor.turns", {{"watercolor.turbulence", "4"}, {"watercolor.spacing", "400"}}},
    {"watercolor.normals", {{"watercolor.relief", "4"}}},
    {"watercolor.paperMotion", {{"watercolor.relief", "4"}, {"watercolor.granulation", "4"}}},
    {"volume.", {{"colorizers.A.grade.tint", "#40FF20"}}},
    {"volume.length", {{"colorizers.A.volume.shape", "capsule"}}},
    {"volume.node", {{"colorizers.A.volume.radius", "2"}}},
    {"volume.rotation", {{"colorizers.A.volume.shape", "box"}, {"colorizers.A.volume.size", "3,0.3,1"}}},
    {"volume.size", {{"colorizers.A.volume.shape", "box"}}},
    {"painting.speed", {{"painting.plays", "on"}}},
    {"painting.warp", {{"warp.amount", "64"}, {"warp.inflation", "64"}}},
    {"warp.", {{"warp.amount", "64"}, {"warp.inflation", "64"}}},
    {"warp.metatexture.skewLevels", {{"warp.metatexture.skew", "exact"}}},
    {"warp.metatexture.tiles", {{"warp.metatexture.mode", "object"}}},
    {"warp.boil", {{"warp.boil", "0.6"}}},
    {"warp.least", {{"warp.distance", "10"}}},
    {"water.",
     {{"ocean.mode", "on"},
      {"ocean.grid", "8"},
      {"ocean.tiles", "3"},
      {"ocean.speed", "3"},
      {"decorations.A.water.at", "0,0,0"}}},
    {"water.radius", {{"decorations.A.water.kind", "ripples"}}},
    {"water.crests", {{"decorations.A.water.kind", "ripples"}}},
    {"water.start", {{"decorations.A.water.kind", "ripples"}}},
    {"water.every", {{"decorations.A.water.kind", "ripples"}}},
};

// Values besides the ends, where the default is one of them or nothing.
const std::map<std::string, std::string> kBetween = {{"camera.target", "Buoy"},
                                                     {"drape.mode", "on"},
                                                     {"ocean.metatexture.contrast", "off"},
                                                     {"ocean.metatexture.radial", "on"},
                                                     {"ocean.mode", "on"},
                                                     {"play.start", "0.3"},
                                                     {"texture.metatexture.radial", "on"},
                                                     {"volume.node", "Buoy"},
                                                     {"volume.rotation", "30,40,50"},
                                                     {"warp.boil", "0.4"},
                                                     {"warp.metatexture.radial", "on"},
                                                     {"water.every", "0.5"},
                                                     {"watercolor.paperMotion", "turn"},
                                                     {"water.node", "Buoy"}};

// Knobs that cannot show here, each with the reason.
const std::map<std::string, std::string> kUnseen = {
    {"breakup.metatexture.cyclopean", "marks lie by the tangents that warp.metatexture chooses"},
    {"breakup.metatexture.gradients", "marks lie by the tangents that warp.metatexture chooses"},
    {"breakup.metatexture.radial", "marks lie by the tangents that warp.metatexture chooses"},
    {"final.bloomReach",
     "in a picture as small as this it is never more than a texel; bloom_test.cpp measures it"},
    {"float.hull", "nothing here holds water; hulls_test.cpp has boats"},
    {"ink.colors.color", "no mesh here has borders of vertex colours; ink_test.cpp draws some"},
    {"ink.colors.colorAmount", "the same"},
    {"ink.colors.shown", "the same"},
    {"ink.colors.width", "the same"},
    {"ink.materials.color", "no mesh here has two materials; ink_test.cpp draws one"},
    {"ink.materials.colorAmount", "the same"},
    {"ink.materials.shown", "the same"},
    {"ink.materials.width", "the same"},
    {"ink.ownOutlines", "no file here brings outlines; ink_test.cpp has one"},
    {"ocean.hulls", "nothing here holds water; hulls_test.cpp has boats"},
    {"ocean.metatexture.orient",
     "seen along -z, strokes of the sea run across the foreshortening as they are"},
    {"palette.planes", "a scene of many colours has none of it"},
    {"warp.characterBoil", "no skeleton moves anything here; posed_warp_test.cpp has one that does"}};

class KnobSweep : public BothEyes {};
INSTANTIATE_BOTH_EYES(KnobSweep);

TEST_P(KnobSweep, everyKnobAtItsEndsDrawsAndShows) {
  TestScene s = stillLife();
  Json masked = TestScene::colored("Leaf", {1, 1, 1, 1}),
       pane = TestScene::colored("Pane", {0.2f, 0.6f, 0.8f, 0.5f});
  Image leaf{16, 16, {"R", "G", "B", "A"}, {}};
  for (int i = 0; i < 16 * 16; ++i) {
    const float value = (i + i / 16) % 2 ? 0.2f : 0.9f;
    leaf.pixels.insert(leaf.pixels.end(), {value, 0.5f, 1 - value, i % 16 < 9 ? 1.0f : 0.0f});
  }
  Image other = leaf;
  for (size_t i = 0; i < other.pixels.size(); i += 4) other.pixels[i] = 0.1f;
  masked["extras"] = {{"scumble_lit_texture", s.texture(other)},
                      {"scumble_shadowed_texture", s.texture(leaf)}};
  masked["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", s.texture(leaf)}};
  masked["alphaMode"] = "MASK", pane["alphaMode"] = "BLEND";
  s.add(gridMesh({-1, 0.2f, 1.5f}, {1, 0, 0}, {0, 1, 0}), s.material(masked));
  s.add(gridMesh({0.2f, 0.2f, 1.2f}, {1.5f, 0, 0}, {0, 1.2f, 0}), s.material(pane));
  // A lamp, and a buoy that a clip moves.
  s.json()["extensions"]["KHR_lights_punctual"]["lights"].push_back(
      {{"type", "point"}, {"intensity", 40}, {"color", {1, 0.8, 0.5}}});
  s.json()["nodes"].push_back(
      {{"translation", {2, 1.5, 1}}, {"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}});
  s.json()["scenes"][0]["nodes"].push_back(s.json()["nodes"].size() - 1);
  s.add(boxMesh({-0.3f, 0, 1.6f}, {0.3f, 0.6f, 2.2f}),
        s.material(TestScene::colored("Buoy", {0.8f, 0.4f, 0.1f, 1})));
  s.json()["nodes"].back()["name"] = "Buoy";
  s.clip("Drift", {0, 1, 2}, {{0, 0, 0}, {1, 0.4f, 0}, {0, 0, 0.5f}});
  s.json()["materials"].back()["extras"] = {{"scumble_shadowed", "#204080"}};
  s.json()["materials"].back()["pbrMetallicRoughness"]["roughnessFactor"] = 0.4;
  s.json()["samplers"] = Json::array({{{"magFilter", 9729}, {"minFilter", 9987}}});  // with mip levels
  const Scene plain = s.load();
  // Strokes: crossing ones at one depth, a sunken one, one that is being painted; for knobs of theirs alone,
  // lest they hide others.
  const glm::vec4 red(0.8f, 0.2f, 0.1f, 0.9f), blue(0.1f, 0.3f, 0.8f, 0.9f);
  s.addStrokes({{{{-2, 0.5f, 2.5f}, {0, 1.2f, 2.4f}, {2, 2.2f, 2.5f}}, 0.35f, red, "bristles", {0, 0.5f, 2}},
                {{{-2, 2.2f, 2.5f}, {0, 1.2f, 2.4f}, {2, 0.5f, 2.5f}}, 0.35f, blue, "bristles", {0, 1, 4}},
                {{{-1.5f, 0.6f, 1.4f}, {1.5f, 0.9f, 1.0f}}, 0.4f, blue, "plain", {0, 1}}});
  const Scene painted = s.load();

  const Stand stand{{2, 1.5f, 6}, {0, 1.2f, 0}};
  // A picture with a hard edge, for knobs about pictures behind everything.
  auto backdrop = std::make_shared<Image>(Image{16, 12, {"R", "G", "B"}, {}});
  for (int i = 0; i < 16 * 12; ++i) {
    const float value = i % 16 < 7 ? 0.1f : 0.5f + 0.02f * float(i % 5);
    backdrop->pixels.insert(backdrop->pixels.end(), {value, 0.3f, 0.6f * value});
  }
  const std::vector<std::string> aovs{"warp", "shadow",       "lit",   "shadowed",
                                      "blur", "final-shadow", "color", "colorize"};
  const auto draw = [&](const Scene& scene, const Look& look, const std::string& what, bool camera,
                        bool behind, Stereo eyes) {
    std::vector<float> seen;
    Viewpoint viewpoint;
    const std::vector<View> views =
        camera ? makeViews(scene, viewpoint, float(kWidth) / kHeight, eyes, stand.ipd, look, kTime).value()
               : viewsFrom(plain, stand, kWidth, kHeight, eyes);
    RenderOptions options = sized(kWidth, kHeight, aovs, 4);
    if (behind) options.background = backdrop;
    const Result<Frame> frame = renderer().render(scene, look, kTime, views, options);
    if (!frame) {
      ADD_FAILURE() << what << ": " << frame.error().message();
      return seen;
    }
    for (const Frame::Layer& layer : frame->layers)
      for (const Image& image : layer.views) {
        EXPECT_TRUE(
            std::all_of(image.pixels.begin(), image.pixels.end(), [](float v) { return std::isfinite(v); }))
            << what << ", layer '" << layer.name << "'";
        seen.insert(seen.end(), image.pixels.begin(), image.pixels.end());
      }
    return seen;
  };
  const auto setWithNeeds = [](Look& look, const Knob& knob, const std::string& value) {
    for (const auto& [beginning, knobs] : kNeeds)
      if (knob.path.starts_with(beginning)) {
        for (const auto& [needed, to] : knobs) EXPECT_TRUE(look.set(needed, to).ok()) << needed;
      }
    const Status set = look.set(settingPath(knob), value);
    EXPECT_TRUE(set.ok()) << knob.path << " = " << value << ": " << set.error().message();
  };
  const auto looksFromCamera = [](const std::string& path) { return path.starts_with("camera."); };
  // Knobs that say how two eyes go together have two to show it with.
  const auto eyesFor = [](const std::string& path) {
    return path.ends_with("cyclopean") ? Stereo::stereo : GetParam();
  };
  const auto needsPicture = [](const std::string& path) {
    return path == "background.style" || path == "background.simplify" || path == "background.steps" ||
           path == "background.warp" || path == "limit.backdrop";
  };
  draw(plain, Look(), "defaults", false, false, GetParam());
  draw(painted, Look(), "defaults", false, false, GetParam());
  EXPECT_GT(Look::knobs().size(), 150u);
  if (kSanitized || viewCount() == 2) {
    // What can go wrong there is memory, and what shows for one eye shows for two: all knobs of a group are
    // at their most together.
    std::map<std::string, Look> groups;
    for (const Knob& knob : Look::knobs())
      setWithNeeds(groups[knob.path.substr(0, knob.path.find('.') + 1)], knob, knob.max);
    for (const auto& [group, look] : groups)
      draw(painted, look, group, looksFromCamera(group), group == "background.", GetParam());
  } else {
    std::set<std::string> unseen;
    for (const Knob& knob : Look::knobs()) {
      // What is named has no least and most: its first and last choice are tried. Where those look the same,
      // so is what lies between: a turn by -180 degrees is one by 180, and a thing a million metres away to
      // either side is gone.
      const auto between = kBetween.find(knob.path);
      std::vector<std::vector<float>> drawn;
      const std::string values[] = {knob.max, knob.min,
                                    between != kBetween.end() ? between->second : knob.defaultValue};
      for (size_t i = 0; i < 3; ++i) {
        if (i == 2 && drawn[0] != drawn[1]) break;
        Look look;
        setWithNeeds(look, knob, values[i]);
        const Scene& scene = knob.path.starts_with("painting.") ? painted : plain;
        drawn.push_back(draw(scene, look, knob.path + " = " + values[i], looksFromCamera(knob.path),
                             needsPicture(knob.path), eyesFor(knob.path)));
      }
      if (drawn.size() == 3 && drawn[0] == drawn[2]) unseen.insert(knob.path);
    }
    for (const std::string& path : unseen)
      EXPECT_TRUE(kUnseen.contains(path)) << path << " does nothing here: give it what it needs in kNeeds";
    for (const auto& [path, why] : kUnseen)
      EXPECT_TRUE(unseen.contains(path) || !hasKnob(path))
          << path << " shows after all, in spite of: " << why;
  }
  // All at their least, and all at their most.
  for (const bool most : {false, true}) {
    Look look;
    for (const Knob& knob : Look::knobs())
      ASSERT_TRUE(look.set(settingPath(knob), most ? knob.max : knob.min).ok());
    draw(painted, look, most ? "all at their most" : "all at their least", false, false, GetParam());
  }
}

}  // namespace
}  // namespace scumble
