// Colorizers (paper 002; FORMULAS 16 and 17): the pass's picture against a reference in double precision from
// the AOVs before it, and what looks promise of identity, order, nodes and numbers.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "passes/colorize/colorize_knobs.h"
#include "tests/support/aov.h"
#include "tests/support/palette_reference.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"
#include "tests/support/sanitized.h"

namespace scumble::passes {
namespace {

using namespace test;

// One colorizer as a test says it, and what it does to a pixel.
struct Reference {
  int shape = kVolumeSphere;
  bool fog = true;
  glm::dmat4 toUnit{1.0};
  double axis = 0, density = 1, falloff = 0.5;
  glm::dvec3 bias{0}, tint{1}, gamma{1};
  double saturation = 1;

  double densityAt(const glm::dvec3& q) const {
    const auto sphere = [](const glm::dvec3& p) { return std::max(1 - glm::dot(p, p), 0.0); };
    const glm::dvec3 box = glm::max(1.0 - q * q, glm::dvec3(0));
    switch (shape) {
      case kVolumeBox:
        return box.x * box.y * box.z;
      case kVolumeCapsule:
        return sphere({q.x, q.y - std::clamp(q.y, -axis, axis), q.z});
      case kVolumeHalfSpace:
        return std::max(-q.y, 0.0);
      case kVolumeScene:
        return 1;
      default:
        return sphere(q);
    }
  }
  double strength(const Ray& ray, double way) const {
    const bool isOpen = shape == kVolumeHalfSpace || shape == kVolumeScene;
    const glm::dvec3 eye(toUnit * glm::dvec4(ray.origin, 1));
    glm::dvec3 along(toUnit * glm::dvec4(ray.direction, 0));
    const double scale = glm::length(along);
    along /= scale, way *= scale;
    if (!fog) {
      if (shape == kVolumeScene) return 1;
      const double densityThere = densityAt(eye + std::min(way, 1e9) * along);
      return isOpen ? 1 - std::exp(-densityThere) : densityThere;
    }
    // An endless way down.
    if (shape == kVolumeHalfSpace && way > 1e20 && along.y < 0) return 1;
    const double reach = isOpen ? 60 : 2 + axis, nearest = isOpen ? 0 : -glm::dot(eye, along);
    const double from = std::max(0.0, nearest - reach), to = std::min(way, nearest + reach);
    if (to <= from) return 0;
    constexpr int kSteps = 600;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
      sum += densityAt(eye + (from + (i + 0.5) * (to - from) / kSteps) * along);
    sum *= (to - from) / kSteps;
    return isOpen ? 1 - std::exp(-sum) : std::min(0.75 * sum, 1.0);
  }
  glm::dvec3 apply(const glm::dvec3& c, const Ray& ray, double way) const {
    const double x = strength(ray, way);
    const double amount = std::min(density * x / (x + (1 - falloff) / falloff * (1 - x)), 1.0);
    const double gray = glm::dot(c, glm::dvec3(0.2126, 0.7152, 0.0722));
    const glm::dvec3 graded =
        glm::pow(glm::max(bias + tint * glm::mix(glm::dvec3(gray), c, saturation), glm::dvec3(0)), gamma);
    return glm::mix(c, graded, amount);
  }
};

class ColorizeTest : public BothEyes {
 protected:
  static constexpr int kWidth = 160, kHeight = 120;

  static std::vector<View> views(const Scene& scene, Stereo stereo) {
    auto views = viewsFrom(scene, {{2, 1.5f, 6}, {0, 1.0f, 0}, 50}, kWidth, kHeight, stereo);
    for (size_t v = 0; v < views.size(); ++v)
      views[v].eyeToClip[2][0] = v == 0 ? 0.1f : -0.15f, views[v].eyeToClip[2][1] = 0.05f;
    return views;
  }
  // Every pixel of "colorize" from "color" and "depth".
  static size_t compare(const Scene& scene, const Look& look, const std::vector<Reference>& references,
                        const std::vector<View>& views, int width = kWidth, int height = kHeight,
                        int step = 1) {
    const Frame frame =
        draw(scene, look, views, sized(uint32_t(width), uint32_t(height), {"color", "depth", "colorize"}));
    size_t changed = 0;
    for (size_t v = 0; v < views.size(); ++v) {
      Difference difference(1.5e-3);
      const glm::dmat4 toEye(views[v].worldToEye);
      for (int y = 0; y < height; y += step)
        for (int x = 0; x < width; x += step) {
          const Ray through = pixelRay(views[v], x, y, width, height);
          Ray ray = through;
          // From the eye, or from its plane, not from the near plane.
          const double ahead = -glm::dvec3(glm::dmat3(toEye) * through.direction).z;
          const double before = glm::dvec3(toEye * glm::dvec4(through.origin, 1)).z / ahead;
          ray.origin += before * through.direction;
          const double distance = texel(aov(frame, "depth", v), x, y).x;
          glm::dvec3 color(texel(aov(frame, "color", v), x, y)), start = color;
          for (const Reference& reference : references)
            color = reference.apply(color, ray, std::isfinite(distance) ? distance / ahead : 1e30);
          const glm::dvec4 got = texel(aov(frame, "colorize", v), x, y);
          changed += glm::length(color - start) > 0.02;
          for (int c = 0; c < 3; ++c) difference.add(got[c], color[c]);
        }
      EXPECT_LE(difference.beyondPart(), 1e-3) << difference.text() << ", view " << v;
      EXPECT_LE(difference.most, 0.02) << difference.text() << ", view " << v;
    }
    return changed;
  }
  static std::string text(const glm::dvec3& v) {
    return std::to_string(v.x) + "," + std::to_string(v.y) + "," + std::to_string(v.z);
  }
  static glm::dvec3 linear(const std::string& hex) {
    return referenceColor(uint32_t(std::strtoul(hex.c_str() + 1, nullptr, 16)));
  }
};
INSTANTIATE_BOTH_EYES(ColorizeTest);

// Every shape and both kinds by themselves, turned, graded and with a curve.
TEST_P(ColorizeTest, everyShapeEqualsItsReference) {
  const Scene scene = stillLife().load();
  const auto from = views(scene, GetParam());
  const char* names[] = {"sphere", "ellipsoid", "box", "capsule", "half-space", "scene"};
  for (int shape = 0; shape < 6; ++shape)
    for (const bool fog : {false, true}) {
      Reference r;
      r.shape = shape, r.fog = fog, r.density = 0.8, r.falloff = 0.6;
      r.bias = {0.1, 0.02, -0.15}, r.gamma = {0.8, 1, 1.3}, r.saturation = 0.5;
      r.tint = 1.4 * linear("#E0B070");
      const glm::dvec3 center(0.2, 0.7, 0.4), size(1.6, 0.9, 2.1);
      const double radius = shape == kVolumeScene ? 9 : 1.3, length = 1.1;
      glm::dmat4 placed = glm::translate(glm::dmat4(1.0), center);
      if (shape != kVolumeSphere && shape != kVolumeScene)
        for (const auto& [degrees, axis] : {std::pair{35.0, 2}, {-20.0, 1}, {50.0, 0}}) {
          glm::dvec3 about(0);
          about[axis] = 1;
          placed = glm::rotate(placed, glm::radians(degrees), about);
        }
      const bool hasSize = shape == kVolumeEllipsoid || shape == kVolumeBox;
      r.toUnit = glm::inverse(glm::scale(placed, hasSize ? size : glm::dvec3(radius)));
      r.axis = shape == kVolumeCapsule ? length / radius : 0;
      const Look look = quietLook({{"colorizers.A.volume.shape", names[shape]},
                                   {"colorizers.A.volume.kind", fog ? "atmospheric" : "surface"},
                                   {"colorizers.A.volume.center", text(center)},
                                   {"colorizers.A.volume.rotation", "50,-20,35"},
                                   {"colorizers.A.volume.radius", std::to_string(radius)},
                                   {"colorizers.A.volume.size", text(size)},
                                   {"colorizers.A.volume.length", std::to_string(length)},
                                   {"colorizers.A.volume.density", "0.8"},
                                   {"colorizers.A.volume.falloff", "0.6"},
                                   {"colorizers.A.grade.bias", "0.1,0.02,-0.15"},
                                   {"colorizers.A.grade.tint", "#E0B070"},
                                   {"colorizers.A.grade.gain", "1.4"},
                                   {"colorizers.A.grade.gamma", "0.8,1,1.3"},
                                   {"colorizers.A.grade.saturation", "0.5"}});
      SCOPED_TRACE(std::string(names[shape]) + (fog ? ", fog" : ", surface"));
      EXPECT_GT(compare(scene, look, {r}, from), 300u);
    }
}

// Along the longest way through each shape fog counts as much as along its axis, whatever the falloff:
// exactly at its default, where the curve is left out, as beside it.
TEST_P(ColorizeTest, longestWaysCountAsTheAxis) {
  NOT_WITH_SANITIZERS();
  const Scene scene = stillLife().load();
  const auto from = viewsFrom(scene, {{0, 1, 9}, {0, 1, 0}, 40}, kWidth, kHeight, GetParam());
  struct Case {
    int shape;
    const char* name;
    glm::dvec3 degrees;  // turns its longest way to the viewer
    glm::dvec3 size;
    double length;
  };
  const Case cases[] = {{kVolumeSphere, "sphere", {0, 0, 0}, {1, 1, 1}, 0},
                        {kVolumeEllipsoid, "ellipsoid", {0, 0, 0}, {0.6, 0.6, 3}, 0},
                        {kVolumeBox, "box", {45, -35.264389682754654, 0}, {1, 1, 1}, 0},
                        {kVolumeCapsule, "capsule", {90, 0, 0}, {1, 1, 1}, 3}};
  for (const Case& one : cases)
    for (const char* falloff : {"0.49", "0.5", "0.51"}) {
      Reference r;
      r.shape = one.shape, r.density = 0.3, r.falloff = std::stod(falloff), r.axis = one.length;
      r.tint = linear("#C03020");
      glm::dmat4 placed = glm::translate(glm::dmat4(1.0), {0, 1, 4});
      for (const int axis : {2, 1, 0}) {
        glm::dvec3 about(0);
        about[axis] = 1;
        placed = glm::rotate(placed, glm::radians(one.degrees[axis]), about);
      }
      r.toUnit = glm::inverse(glm::scale(placed, one.size));
      const Look look = quietLook({{"colorizers.A.volume.shape", one.name},
                                   {"colorizers.A.volume.kind", "atmospheric"},
                                   {"colorizers.A.volume.center", "0,1,4"},
                                   {"colorizers.A.volume.rotation", text(one.degrees)},
                                   {"colorizers.A.volume.size", text(one.size)},
                                   {"colorizers.A.volume.length", std::to_string(one.length)},
                                   {"colorizers.A.volume.density", "0.3"},
                                   {"colorizers.A.volume.falloff", falloff},
                                   {"colorizers.A.grade.tint", "#C03020"}});
      SCOPED_TRACE(std::string(one.name) + ", falloff " + falloff);
      EXPECT_GT(compare(scene, look, {r}, from), 300u);
    }
}

TEST_F(ColorizeTest, parallelProjection) {
  const Scene scene = stillLife().load();
  Reference sphere, box;
  sphere.toUnit = glm::inverse(glm::scale(glm::translate(glm::dmat4(1.0), {0.5, 1, 0}), glm::dvec3(2.0)));
  sphere.tint = linear("#804020");
  box = sphere, box.shape = kVolumeBox, box.fog = false;
  const Look look = quietLook({{"colorizers.A.volume.kind", "atmospheric"},
                               {"colorizers.A.volume.center", "0.5,1,0"},
                               {"colorizers.A.volume.radius", "2"},
                               {"colorizers.A.grade.tint", "#804020"},
                               {"colorizers.B.volume.shape", "box"},
                               {"colorizers.B.volume.center", "0.5,1,0"},
                               {"colorizers.B.volume.size", "2,2,2"},
                               {"colorizers.B.grade.tint", "#804020"}});
  EXPECT_GT(compare(scene, look, {sphere, box}, {parallelView(3, 4.0f / 3)}), 300u);
}

// The order of the look: grey and then warm is not warm and then grey.
TEST_F(ColorizeTest, onesAfterTheOtherAsListed) {
  const Scene scene = stillLife().load();
  const auto from = views(scene, Stereo::mono);
  Reference gray, warm;
  gray.shape = warm.shape = kVolumeScene, gray.fog = warm.fog = false;
  gray.saturation = 0, warm.tint = linear("#FF8040");
  const std::string a = R"("Z gray": {"volume": {"shape": "scene"}, "grade": {"saturation": 0}})",
                    b = R"("A warm": {"volume": {"shape": "scene"}, "grade": {"tint": "#FF8040"}})";
  const std::string head = R"({"ground": {"mode": "off"}, "background": {"air": 0}, "colorizers": {)";
  const auto read = [&](const std::string& text) { return Look::fromJson(head + text + "}}", "t").value(); };
  EXPECT_GT(compare(scene, read(a + "," + b), {gray, warm}, from), 1000u);
  EXPECT_GT(compare(scene, read(b + "," + a), {warm, gray}, from), 1000u);
}

TEST_P(ColorizeTest, identityLeavesEveryBit) {
  const Scene scene = stillLife().load();
  const auto from = views(scene, GetParam());
  for (const bool transparent : {false, true}) {
    RenderOptions options = sized(kWidth, kHeight, {"color", "colorize"}, 4);
    options.transparent = transparent;
    const Frame without = draw(scene, quietLook(), from, options);
    // Nothing to grade; nothing to grade with; and nowhere to be seen, beside one that is.
    const std::vector<std::vector<std::pair<std::string, std::string>>> looks{
        {},
        {{"colorizers.A.volume.shape", "scene"}},
        {{"colorizers.A.volume.shape", "scene"},
         {"colorizers.A.grade.bias", "1,0,0"},
         {"colorizers.A.volume.density", "0"}},
        {{"colorizers.A.volume.shape", "capsule"},
         {"colorizers.A.volume.center", "0,-900,0"},
         {"colorizers.A.volume.falloff", "0.9"},
         {"colorizers.A.grade.gamma", "2,3,4"},
         {"colorizers.A.grade.saturation", "0"}},
        {{"colorizers.A.volume.node", "no such node"},
         {"colorizers.A.volume.shape", "scene"},
         {"colorizers.A.grade.bias", "1,0,0"}}};
    for (const auto& knobs : looks) {
      const Frame with = draw(scene, quietLook(knobs), from, options);
      for (size_t v = 0; v < from.size(); ++v) {
        EXPECT_TRUE(sameBytes(aov(with, "colorize", v), aov(without, "color", v))) << knobs.size();
        EXPECT_TRUE(sameBytes(aov(with, "", v), aov(without, "", v))) << knobs.size();
      }
    }
  }
}

// What is partly covered is graded as what is covered wholly, and stays as it is covered.
TEST_P(ColorizeTest, transparentPicturesAreGradedStraight) {
  const Scene scene = stillLife().load();
  const auto from = views(scene, GetParam());
  RenderOptions options = sized(kWidth, kHeight, {"color", "colorize"}, 4);
  options.transparent = true;
  const Look look = quietLook({{"colorizers.A.volume.shape", "scene"},
                               {"colorizers.A.volume.kind", "surface"},
                               {"colorizers.A.volume.density", "0.8"},
                               {"colorizers.A.grade.bias", "0.2,0.05,0.1"},
                               {"colorizers.A.grade.saturation", "0.5"}});
  const Frame frame = draw(scene, look, from, options);
  for (size_t v = 0; v < from.size(); ++v) {
    Difference difference(2.5e-3);  // halves of colours times coverages of a quarter and more
    size_t partly = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const glm::dvec4 before = texel(aov(frame, "color", v), x, y),
                         got = texel(aov(frame, "colorize", v), x, y);
        EXPECT_EQ(got.w, before.w);
        if (before.w == 0) continue;
        partly += before.w < 1;
        const glm::dvec3 c(before), gray(glm::dot(c, glm::dvec3(0.2126, 0.7152, 0.0722)));
        const glm::dvec3 graded = glm::dvec3(0.2, 0.05, 0.1) + glm::mix(gray, c, 0.5);
        for (int i = 0; i < 3; ++i) difference.add(got[i], glm::mix(c, graded, 0.8)[i]);
      }
    EXPECT_GT(partly, 100u);
    EXPECT_EQ(difference.beyond, 0u) << difference.text();
  }
}

// Behind the first surface as well, where layered ripple shows it.
TEST_P(ColorizeTest, layeredRippleShowsGradedColours) {
  const Scene scene = stillLife().load();
  const Look look = quietLook({{"final.ripple", "layered"},
                               {"warp.amount", "40"},
                               {"colorizers.A.volume.shape", "scene"},
                               {"colorizers.A.grade.tint", "#FF0000"},
                               {"final.bloom", "0"}});
  const Frame frame = draw(scene, look, views(scene, GetParam()), sized(kWidth, kHeight));
  for (size_t v = 0; v < viewCount(); ++v)
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) ASSERT_EQ(texel(aov(frame, "", v), x, y).y, 0) << x << " " << y;
}

// Many small ones on a picture of many tiles; the reference knows no tiles. The last round has all that a
// look may declare.
TEST_P(ColorizeTest, tilesSkipNothingThatIsSeen) {
  NOT_WITH_SANITIZERS();
  const Scene scene = stillLife().load();
  std::mt19937 random(3);
  const auto number = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  constexpr int kWide = 400, kHigh = 200;
  const auto from = viewsFrom(scene, {{2, 1.5f, 6}, {0, 1.0f, 0}, 60}, kWide, kHigh, GetParam());
  for (const int count : {20, 64}) {
    std::vector<std::pair<std::string, std::string>> knobs;
    std::vector<Reference> references(static_cast<size_t>(count));
    for (int i = 0; i < count; ++i) {
      const std::string path = "colorizers.c" + std::to_string(i) + ".";
      Reference& r = references[size_t(i)];
      const bool isBox = count == 20 && i % 2;
      const glm::dvec3 center(number(-5, 6), number(-1, 3), number(-5, 8));
      const double radius = number(0.1, 1.2);
      r.fog = i % 3 != 0;
      r.shape = isBox ? kVolumeBox : kVolumeSphere;
      r.toUnit = glm::inverse(glm::scale(glm::translate(glm::dmat4(1.0), center), glm::dvec3(radius)));
      r.tint = linear(i % 2 ? "#FF9060" : "#70A0FF"), r.saturation = 0.7;
      knobs.insert(knobs.end(), {{path + "volume.shape", isBox ? "box" : "sphere"},
                                 {path + "volume.kind", r.fog ? "atmospheric" : "surface"},
                                 {path + "volume.center", text(center)},
                                 {path + "volume.radius", std::to_string(radius)},
                                 {path + "volume.size", text(glm::dvec3(radius))},
                                 {path + "grade.tint", i % 2 ? "#FF9060" : "#70A0FF"},
                                 {path + "grade.saturation", "0.7"}});
    }
    EXPECT_GT(compare(scene, quietLook(knobs), references, from, kWide, kHigh, 3), 300u);
  }
}

// As fragment shaders and as compute shaders; on a size that no tile divides.
TEST_P(ColorizeTest, fragmentAndComputeGiveOnePicture) {
  const Scene scene = stillLife().load();
  const auto from = viewsFrom(scene, {{2, 1.5f, 6}, {0, 1.0f, 0}, 60}, 301, 149, GetParam());
  const Look look = quietLook({{"colorizers.A.volume.kind", "atmospheric"},
                               {"colorizers.A.volume.center", "1.5,0.5,1"},
                               {"colorizers.A.grade.bias", "0.3,0,0"},
                               {"colorizers.B.volume.shape", "capsule"},
                               {"colorizers.B.volume.center", "-1,0.5,0"},
                               {"colorizers.B.grade.gamma", "2,1,0.5"}});
  const RenderOptions options = sized(301, 149, {"color", "colorize"});
  const Frame fragment = draw(scene, look, from, options);
  Result<Frame> compute = otherRenderer().render(scene, look, 0, from, options);
  ASSERT_TRUE(compute.ok()) << compute.error().message();
  for (size_t v = 0; v < viewCount(); ++v) {
    Difference difference(4e-3);
    const Image &a = aov(fragment, "colorize", v), &b = aov(*compute, "colorize", v);
    for (size_t i = 0; i < a.pixels.size(); ++i) difference.add(a.pixels[i], b.pixels[i]);
    EXPECT_LT(difference.beyondPart(), 2e-3) << difference.text();
    EXPECT_FALSE(sameBytes(a, aov(fragment, "color", v)));
  }
}

// What hangs on a node moves with it, on twos where it is held.
TEST_F(ColorizeTest, hangsOnAnAnimatedNode) {
  TestScene s = stillLife();
  Json& json = s.json();
  const int node = int(json["nodes"].size());
  json["nodes"].push_back({{"name", "Lantern"}, {"translation", {0, 1, 0}}});
  json["scenes"][0]["nodes"].push_back(node);
  const Scene plain = s.load();
  const auto from = views(plain, Stereo::mono);
  const RenderOptions options = sized(kWidth, kHeight, {"colorize"});
  const std::vector<std::pair<std::string, std::string>> glow{{"colorizers.G.volume.kind", "atmospheric"},
                                                              {"colorizers.G.grade.tint", "#FF8040"}};
  auto onNode = glow, inWorld = glow;
  onNode.insert(onNode.end(),
                {{"colorizers.G.volume.node", "Lantern"}, {"colorizers.G.volume.center", "0.5,0,0"}});
  inWorld.insert(inWorld.end(), {{"colorizers.G.volume.center", "0.5,1,0"}});
  const Frame a = draw(plain, quietLook(onNode), from, options),
              b = draw(plain, quietLook(inWorld), from, options);
  EXPECT_TRUE(sameBytes(aov(a, "colorize"), aov(b, "colorize")));
  EXPECT_FALSE(sameBytes(aov(a, "colorize"), aov(draw(plain, quietLook(), from, options), "colorize")));
}

}  // namespace
}  // namespace scumble::passes
