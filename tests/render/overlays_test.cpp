// Everything that is drawn passes through everything that acts on colours, at its own distance: surfaces,
// sheets seen from both sides, blended surfaces, strokes in space, layers of paint, and lines; also where
// they are laid over the picture late. And blended surfaces have a light and a shadow side, and a shadow.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "tests/support/aov.h"
#include "tests/support/palette_reference.h"
#include "tests/support/plain_wash.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"

namespace scumble {
namespace {

using namespace test;

enum class Kind { surface, sheet, blended, strokes, layers, lines };
constexpr Kind kKinds[] = {Kind::surface, Kind::sheet,  Kind::blended,
                           Kind::strokes, Kind::layers, Kind::lines};
const char* name(Kind kind) {
  const char* const names[] = {"surface", "sheet", "blended surface", "strokes", "layers of paint", "lines"};
  return names[size_t(kind)];
}

const glm::vec4 kGreen(0.1f, 0.6f, 0.2f, 1);
// Of blended surfaces.
constexpr float kOpacity = 0.4f;

class OverlaysTest : public RenderTest,
                     public ::testing::WithParamInterface<std::tuple<Stereo, uint32_t, float>> {
 protected:
  static constexpr int kWidth = 128, kHeight = 96;

  static Stereo stereo() { return std::get<0>(GetParam()); }
  static uint32_t samples() { return std::get<1>(GetParam()); }
  // Metres of what the test calls one.
  static float scale() { return std::get<2>(GetParam()); }
  static std::string length(double one) { return std::to_string(one * double(scale())); }
  static std::string place(double x, double y, double z) {
    return length(x) + "," + length(y) + "," + length(z);
  }

  // A green thing of this kind around a place, and a wall of grey far behind it.
  static Scene sceneOf(Kind kind, const glm::vec3& at = {0, 0, 0}) {
    const float one = scale();
    TestScene s;
    s.add(gridMesh(one * glm::vec3(-40, -40, -12), {80 * one, 0, 0}, {0, 80 * one, 0}),
          s.material(TestScene::unlit("Wall", {0.4f, 0.4f, 0.4f, 1})));
    // Beside what is seen, and so far ahead that the scene's middle, where air begins, is near the viewer.
    s.add(boxMesh(one * glm::vec3(30, 0, 18), one * glm::vec3(31, 1, 20)), 0);
    const TestMesh square =
        gridMesh(one * (at + glm::vec3(-0.8f, -0.8f, 0)), {1.6f * one, 0, 0}, {0, 1.6f * one, 0});
    Json material = TestScene::unlit("Thing", kGreen);
    switch (kind) {
      case Kind::surface:
        s.add(square, s.material(material));
        break;
      case Kind::sheet: {
        TestMesh turned = square;
        std::reverse(turned.indices.begin(), turned.indices.end());
        for (glm::vec3& normal : turned.normals) normal = -normal;
        material["doubleSided"] = true;
        s.add(turned, s.material(material));
        break;
      }
      case Kind::blended:
        material["alphaMode"] = "BLEND";
        material["pbrMetallicRoughness"]["baseColorFactor"][3] = kOpacity;
        s.add(square, s.material(material));
        break;
      case Kind::strokes: {
        std::vector<TestStroke> strokes;
        for (int i = 0; i < 7; ++i) {
          const float y = -0.75f + 0.25f * float(i);
          strokes.push_back({{one * (at + glm::vec3(-0.8f, y, 0)), one * (at + glm::vec3(0.8f, y, 0))},
                             0.2f * one,
                             kGreen});
        }
        s.addStrokes(strokes);
        break;
      }
      case Kind::layers:
        material["alphaMode"] = "BLEND";
        material["extras"]["scumble_paint"] = Json::object();
        s.add(square, s.material(material));
        break;
      case Kind::lines:
        // As grey as the wall.
        s.add(boxMesh(one * (at - glm::vec3(0.8f, 0.8f, 0.02f)), one * (at + glm::vec3(0.8f, 0.8f, 0.02f))),
              s.material(TestScene::unlit("Thing", {0.4f, 0.4f, 0.4f, 1})));
        break;
    }
    return s.load();
  }
  static Look lookOf(Kind kind, const Knobs& more = {}) {
    Knobs knobs{{"warp.amount", "0"}, {"painting.variation", "0"}, {"painting.streaks", "0"}};
    if (kind == Kind::lines)
      knobs.insert(knobs.end(), {{"ink.shown", "on"},
                                 {"ink.line.color", "#59C97C"},
                                 {"ink.least", "60"},
                                 {"ink.greatest", "60"},
                                 {"ink.fade", "0"}});
    knobs.insert(knobs.end(), more.begin(), more.end());
    return quietLook(knobs);
  }
  static std::vector<View> views(const Scene& scene) {
    return viewsFrom(scene, {{0, 0, 5 * scale()}, {0, 0, 0}, 40, 0, 0.06f * scale()}, kWidth, kHeight,
                     stereo());
  }
  static Frame drawn(Kind kind, const Knobs& more = {}, const glm::vec3& at = {0, 0, 0}) {
    const Scene scene = sceneOf(kind, at);
    return draw(scene, lookOf(kind, more), views(scene), sized(kWidth, kHeight, {}, samples()));
  }
  size_t viewCount() const { return stereo() == Stereo::stereo ? 2 : 1; }

  // Pixels that are as green as the thing is; wholly of it.
  static std::vector<glm::ivec2> greenPixels(const Frame& frame, size_t view) {
    const auto greenAt = [&](int x, int y) {
      const glm::dvec4 color = texel(aov(frame, "", view), x, y);
      return color.y - color.x;
    };
    double most = 0.15;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) most = std::max(most, greenAt(x, y));
    std::vector<glm::ivec2> pixels;
    for (int y = 1; y < kHeight - 1; ++y)
      for (int x = 1; x < kWidth - 1; ++x) {
        const double least = std::min(
            {greenAt(x, y), greenAt(x - 1, y), greenAt(x + 1, y), greenAt(x, y - 1), greenAt(x, y + 1)});
        if (least > 0.95 * most) pixels.emplace_back(x, y);
      }
    return pixels;
  }
};
INSTANTIATE_TEST_SUITE_P(Kinds, OverlaysTest,
                         ::testing::Values(std::tuple{Stereo::mono, 1u, 1.0f},
                                           std::tuple{Stereo::stereo, 4u, 1.0f},
                                           std::tuple{Stereo::mono, 4u, 1e-2f},
                                           std::tuple{Stereo::stereo, 1u, 1e3f}));

// A colorizer of all that leaves nothing but red.
TEST_P(OverlaysTest, everythingIsGraded) {
  for (const Kind kind : kKinds) {
    const Frame plain = drawn(kind), red = drawn(kind, {{"colorizers.A.volume.shape", "scene"},
                                                        {"colorizers.A.grade.tint", "#FF0000"}});
    for (size_t v = 0; v < viewCount(); ++v) {
      EXPECT_GT(greenPixels(plain, v).size(), 150u) << name(kind);
      double most = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
          most = std::max({most, texel(aov(red, "", v), x, y).y, texel(aov(red, "", v), x, y).z});
      EXPECT_LT(most, 0.02) << name(kind) << ", view " << v;
    }
  }
}

// Ground, sky and sea, with a box between them.
TEST_P(OverlaysTest, groundSeaAndSkyAreGraded) {
  if (scale() != 1) GTEST_SKIP() << "a sea has metres of its own";
  TestScene s;
  s.add(boxMesh({-0.8f, 0, -0.8f}, {0.8f, 1.6f, 0.8f}), s.material(TestScene::unlit("Box", kGreen)));
  const Scene scene = s.load();
  const auto from = viewsFrom(scene, {{0, 3, 6}, {0, 1, 0}, 50}, kWidth, kHeight, stereo());
  const Knobs red{{"colorizers.A.volume.shape", "scene"}, {"colorizers.A.grade.tint", "#FF0000"}},
      fog{{"colorizers.A.volume.shape", "scene"},
          {"colorizers.A.volume.kind", "atmospheric"},
          {"colorizers.A.volume.radius", "0.1"},
          {"colorizers.A.grade.tint", "#000000"},
          {"colorizers.A.grade.bias", "0.6,0,0"}};
  for (const char* below : {"ground.mode", "ocean.mode"}) {
    if (!hasKnob(below)) continue;
    for (const Knobs& of : {red, fog}) {
      Knobs knobs = of;
      knobs.emplace_back(below, "on");
      const Frame frame = draw(scene, quietLook(knobs), from, sized(kWidth, kHeight, {}, samples()));
      for (size_t v = 0; v < viewCount(); ++v) {
        double most = 0;
        for (int y = 0; y < kHeight; ++y)
          for (int x = 0; x < kWidth; ++x)
            most = std::max({most, texel(aov(frame, "", v), x, y).y, texel(aov(frame, "", v), x, y).z});
        EXPECT_LT(most, 0.02) << below << ", view " << v;
      }
    }
  }
}

TEST_P(OverlaysTest, groundSeaAndSkyAreLimited) {
  if (scale() != 1) GTEST_SKIP() << "a sea has metres of its own";
  TestScene s;
  s.add(boxMesh({-0.8f, 0, -0.8f}, {0.8f, 1.6f, 0.8f}), s.material(TestScene::unlit("Box", kGreen)));
  const Scene scene = s.load();
  const auto from = viewsFrom(scene, {{0, 3, 6}, {0, 1, 0}, 50}, kWidth, kHeight, stereo());
  for (const char* below : {"ground.mode", "ocean.mode"}) {
    if (!hasKnob(below)) continue;
    const Frame frame = draw(scene,
                             quietLook({{below, "on"},
                                        {"limit.palette", "look"},
                                        {"limit.colors", "2"},
                                        {"limit.dither", "0"},
                                        {"limit.color1", "#303030"},
                                        {"limit.color2", "#D0D0D0"}}),
                             from, sized(kWidth, kHeight, {}, samples()));
    const double dark = referenceColor(0x303030).x, light = referenceColor(0xD0D0D0).x;
    for (size_t v = 0; v < viewCount(); ++v) {
      size_t others = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const glm::dvec4 color = texel(aov(frame, "", v), x, y);
          others += std::min(std::abs(color.y - dark), std::abs(color.y - light)) > 0.02;
        }
      // Edges are mixtures of both.
      EXPECT_LT(others, size_t(kWidth * kHeight / 6)) << below << ", view " << v;
    }
  }
}

// Nothing is seen in fog that lets nothing through.
TEST_P(OverlaysTest, nothingStandsOutInOpaqueFog) {
  for (const Kind kind : kKinds) {
    const Frame fog = drawn(kind, {{"colorizers.A.volume.shape", "scene"},
                                   {"colorizers.A.volume.kind", "atmospheric"},
                                   {"colorizers.A.volume.radius", length(0.1)},
                                   {"colorizers.A.grade.tint", "#000000"},
                                   {"colorizers.A.grade.bias", "0.3,0.4,0.5"}});
    for (size_t v = 0; v < viewCount(); ++v) {
      const glm::dvec4 first = texel(aov(fog, "", v), 0, 0);
      EXPECT_GT(first.z, first.x);
      double most = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
          most = std::max(most, glm::length(texel(aov(fog, "", v), x, y) - first));
      EXPECT_LT(most, 0.02) << name(kind) << ", view " << v;
    }
  }
}

// Fog as thick as it is to a surface that stands there: near the eye and far from it.
TEST_P(OverlaysTest, fogCountsToWhereAThingStands) {
  const Knobs fog{{"colorizers.A.volume.shape", "scene"},
                  {"colorizers.A.volume.kind", "atmospheric"},
                  {"colorizers.A.volume.radius", length(6)},
                  {"colorizers.A.grade.tint", "#000000"},
                  {"colorizers.A.grade.bias", "0.7,0.1,0.1"}};
  double least = 1e9, most = 0;
  for (const float z : {1.5f, 0.0f, -6.0f}) {
    std::vector<glm::dvec3> meanOf;
    for (const Kind kind : kKinds) {
      const Frame plain = drawn(kind, {}, {0, 0, z}), fogged = drawn(kind, fog, {0, 0, z});
      for (size_t v = 0; v < viewCount(); ++v) {
        glm::dvec3 mean(0);
        const auto pixels = greenPixels(plain, v);
        ASSERT_GT(pixels.size(), 20u) << name(kind) << " at " << z;
        for (const glm::ivec2& at : pixels)
          mean += glm::dvec3(texel(aov(fogged, "", v), at.x, at.y)) / double(pixels.size());
        if (kind == Kind::blended) {
          // Beside the thing there is nothing but the wall; blended colours are mixed as square roots.
          const glm::dvec3 wall(texel(aov(fogged, "", v), 3, kHeight / 2));
          mean = (glm::sqrt(mean) - double(1 - kOpacity) * glm::sqrt(wall)) / double(kOpacity);
          mean *= mean;
        }
        meanOf.push_back(mean);
        EXPECT_LT(glm::length(mean - meanOf[0]), kind == Kind::lines     ? 0.12
                                                 : kind == Kind::blended ? 0.05
                                                                         : 0.03)
            << name(kind) << " at " << z << ", view " << v;
      }
    }
    least = std::min(least, meanOf[0].x), most = std::max(most, meanOf[0].x);
  }
  EXPECT_GT(most - least, 0.15);
}

// Fog behind a thing leaves it as it is.
TEST_P(OverlaysTest, fogBehindLeavesColoursAlone) {
  const Knobs fog{{"colorizers.A.volume.shape", "box"},
                  {"colorizers.A.volume.kind", "atmospheric"},
                  {"colorizers.A.volume.center", place(0, 0, -6)},
                  {"colorizers.A.volume.size", place(20, 20, 3)},
                  {"colorizers.A.volume.density", "16"},
                  {"colorizers.A.grade.tint", "#000000"},
                  {"colorizers.A.grade.bias", "0.7,0.1,0.1"}};
  for (const Kind kind : kKinds) {
    if (kind == Kind::blended) continue;  // what is behind shows through it
    const Frame plain = drawn(kind), fogged = drawn(kind, fog);
    for (size_t v = 0; v < viewCount(); ++v) {
      double most = 0;
      for (const glm::ivec2& at : greenPixels(plain, v)) {
        most = std::max(
            most, glm::length(texel(aov(fogged, "", v), at.x, at.y) - texel(aov(plain, "", v), at.x, at.y)));
      }
      EXPECT_LT(most, 0.05) << name(kind) << ", view " << v;
      EXPECT_GT(glm::length(texel(aov(fogged, "", v), 2, 2) - texel(aov(plain, "", v), 2, 2)), 0.2);
    }
  }
}

// What lies in fog is hidden by it, through a blended surface that stands before it, too; and that stays.
TEST_P(OverlaysTest, blendedSurfacesStandBeforeFogAndInIt) {
  const Knobs opaque{
      {"colorizers.A.volume.shape", "box"},           {"colorizers.A.volume.kind", "atmospheric"},
      {"colorizers.A.volume.size", place(60, 60, 3)}, {"colorizers.A.volume.density", "16"},
      {"colorizers.A.grade.tint", "#000000"},         {"colorizers.A.grade.bias", "0.7,0.1,0.1"}};
  const glm::dvec3 fog(0.7, 0.1, 0.1);
  for (const bool isBefore : {true, false}) {
    Knobs knobs = opaque;
    knobs.emplace_back("colorizers.A.volume.center", place(0, 0, isBefore ? -6 : 0));
    const Frame plain = drawn(Kind::blended), fogged = drawn(Kind::blended, knobs);
    glm::dvec3 expected = fog;
    if (isBefore) {
      expected = double(kOpacity) * glm::sqrt(glm::dvec3(kGreen)) + double(1 - kOpacity) * glm::sqrt(fog);
      expected *= expected;
    }
    for (size_t v = 0; v < viewCount(); ++v) {
      const auto pixels = greenPixels(plain, v);
      ASSERT_GT(pixels.size(), 150u);
      double most = 0;
      for (const glm::ivec2& at : pixels)
        most = std::max(most, glm::length(glm::dvec3(texel(aov(fogged, "", v), at.x, at.y)) - expected));
      EXPECT_LT(most, 0.06) << (isBefore ? "before" : "in") << ", view " << v;
    }
  }
}

// A box of glass: its sides differ as much as those of an opaque one do, as far as it is there; and what lies
// behind it in the light is darker by as much.
TEST_P(OverlaysTest, blendedThingsHaveASideInShadowAndAShadow) {
  const float one = scale();
  std::vector<View> from;
  const auto drawnAs = [&](const glm::vec4& color) {
    TestScene s;
    Json box = TestScene::colored("Box", color);
    if (color.a < 1) box["alphaMode"] = "BLEND";
    s.add(boxMesh(one * glm::vec3(-0.6f, -0.2f, -0.6f), one * glm::vec3(0.6f, 1, 0.6f)), s.material(box));
    s.add(gridMesh(one * glm::vec3(-12, -1, 12), {24 * one, 0, 0}, {0, 0, -24 * one}),
          s.material(TestScene::colored("Floor", {0.5f, 0.5f, 0.5f, 1})));
    s.light({-1, 1.2f, 0.4f});
    const Scene scene = s.load();
    from = viewsFrom(scene, {one * glm::vec3(3, 3, 6), one * glm::vec3(0.8f, 0, 0), 45, 0, 0.06f * one},
                     kWidth, kHeight, stereo());
    return draw(scene,
                quietLook({{"warp.amount", "0"},
                           {"shadow.innerGlow", "0"},
                           {"shadow.indication", "0"},
                           {"palette.planes", "0"}}),
                from, sized(kWidth, kHeight, {}, samples()));
  };
  const Frame solid = drawnAs({0.6f, 0.3f, 0.1f, 1}), glass = drawnAs({0.6f, 0.3f, 0.1f, kOpacity}),
              empty = drawnAs({0.6f, 0.3f, 0.1f, 0.001f});
  for (size_t v = 0; v < viewCount(); ++v) {
    const auto rootAt = [&](const Frame& frame, const glm::dvec3& at) {
      const glm::ivec2 pixel(pixelOf(from[v], double(one) * at, kWidth, kHeight));
      return glm::sqrt(glm::dvec3(texel(aov(frame, "", v), pixel.x, pixel.y)));
    };
    const auto colorAt = [&](const Frame& frame, const glm::dvec3& at) {
      const glm::dvec3 root = rootAt(frame, at);
      return root * root;
    };
    // Its top lies in light, and its right side in shadow.
    const glm::dvec3 top(0.1, 1, 0.1), side(0.6, 0.5, 0.1);
    for (const glm::dvec3& at : {top, side}) {
      const glm::dvec3 own =
          (rootAt(glass, at) - double(1 - kOpacity) * rootAt(empty, at)) / double(kOpacity);
      EXPECT_LT(glm::length(own - rootAt(solid, at)), 0.25) << at.x << ", view " << v;
    }
    EXPECT_GT(glm::length(rootAt(solid, top) - rootAt(solid, side)), 0.15);
    EXPECT_GT(glm::length(rootAt(glass, top) - rootAt(glass, side)), 0.05);
    // On the floor, in the middle of the shadow and beside it.
    const glm::dvec3 inside(1.4, -1, -0.45), outside(1.4, -1, 2.5);
    const glm::dvec3 whole = colorAt(solid, outside) - colorAt(solid, inside),
                     pale = colorAt(empty, inside) - colorAt(glass, inside);
    EXPECT_GT(glm::length(whole), 0.1);
    EXPECT_NEAR(glm::length(pale) / glm::length(whole), double(kOpacity), 0.08) << "view " << v;
    EXPECT_LT(glm::length(colorAt(empty, outside) - colorAt(glass, outside)), 0.01);
  }
}

// Air, as far as it goes: what stands in it dissolves as a surface does.
TEST_P(OverlaysTest, airLiesBeforeEverything) {
  const Knobs air{{"background.air", "1"}, {"background.airStart", "0"}, {"background.airEnd", "0.15"}};
  std::vector<glm::dvec3> meanOf;
  for (const Kind kind : kKinds) {
    const Frame plain = drawn(kind), aired = drawn(kind, air);
    for (size_t v = 0; v < viewCount(); ++v) {
      glm::dvec3 mean(0), before(0);
      const auto pixels = greenPixels(plain, v);
      for (const glm::ivec2& at : pixels) {
        mean += glm::dvec3(texel(aov(aired, "", v), at.x, at.y)) / double(pixels.size());
        before += glm::dvec3(texel(aov(plain, "", v), at.x, at.y)) / double(pixels.size());
      }
      meanOf.push_back(mean);
      EXPECT_GT(glm::length(mean - before), 0.05) << name(kind);
      glm::dvec3 expected = meanOf[0];
      if (kind == Kind::blended) {
        // What shows through lies in more air, at its own distance.
        const glm::dvec3 wall(texel(aov(aired, "", v), 3, 3));
        const glm::dvec3 root = glm::mix(glm::sqrt(wall), glm::sqrt(meanOf[0]), double(kOpacity));
        expected = root * root;
        EXPECT_GT(glm::length(wall - meanOf[0]), 0.1) << "there is more of it";
      }
      EXPECT_LT(glm::length(mean - expected), kind == Kind::blended ? 0.01 : 0.05)
          << name(kind) << ", view " << v;
    }
  }
}

// A blended surface is graded as it is in the air before it, and what shows through it as that is in its own:
// where the one becomes black, all of the other is left.
TEST_P(OverlaysTest, blendedSurfacesAreGradedInTheirAir) {
  const Knobs air{{"background.air", "0.7"}, {"background.airStart", "0"}, {"background.airEnd", "0.15"}};
  Knobs graded = air;
  graded.insert(graded.end(), {{"colorizers.A.volume.shape", "box"},
                               {"colorizers.A.volume.size", place(20, 20, 3)},
                               {"colorizers.A.volume.density", "16"},
                               {"colorizers.A.grade.tint", "#000000"}});
  const Frame plain = drawn(Kind::blended), aired = drawn(Kind::blended, air),
              black = drawn(Kind::blended, graded);
  for (size_t v = 0; v < viewCount(); ++v) {
    const auto pixels = greenPixels(plain, v);
    ASSERT_GT(pixels.size(), 100u);
    Difference rgb(0.01);
    double changes = 0;
    for (const glm::ivec2& at : pixels) {
      const glm::dvec3 root = (1 - double(kOpacity)) * glm::sqrt(glm::dvec3(texel(aov(aired, "", v), 3, 3)));
      for (int c = 0; c < 3; ++c) rgb.add(texel(aov(black, "", v), at.x, at.y)[c], root[c] * root[c]);
      changes = std::max(
          changes, glm::length(texel(aov(aired, "", v), at.x, at.y) - texel(aov(plain, "", v), at.x, at.y)));
    }
    EXPECT_GT(changes, 0.05) << "there is air before it";
    EXPECT_LT(rgb.beyondPart(), 0.02) << "view " << v << ": " << rgb.text();
  }
}

// But for edges, a limited palette has no other colours.
TEST_P(OverlaysTest, aLimitedPaletteHasNoOtherColours) {
  const char* const palette[] = {"#202020", "#808080", "#C8B040", "#E8E8E8"};
  Knobs limited{{"limit.palette", "look"}, {"limit.colors", "4"}, {"limit.dither", "0"}};
  for (size_t i = 0; i < std::size(palette); ++i)
    limited.emplace_back("limit.color" + std::to_string(i + 1), palette[i]);
  for (const Kind kind : kKinds) {
    const Frame plain = drawn(kind), few = drawn(kind, limited);
    for (size_t v = 0; v < viewCount(); ++v) {
      const auto pixels = greenPixels(plain, v);
      size_t others = 0;
      for (const glm::ivec2& at : pixels) {
        const glm::dvec3 got(texel(aov(few, "", v), at.x, at.y));
        double nearest = 1e9;
        for (const char* const hex : palette)
          nearest = std::min(
              nearest,
              glm::length(got - glm::dvec3(referenceColor(uint32_t(std::strtoul(hex + 1, nullptr, 16))))));
        others += nearest > 0.02;
      }
      EXPECT_LE(others, pixels.size() / 20) << name(kind) << ", view " << v;
    }
  }
}

// A painting that runs out before the frame ends takes its lines along.
class PaintingsMargin : public BothEyes {};
INSTANTIATE_BOTH_EYES(PaintingsMargin);

TEST_P(PaintingsMargin, linesEndWhereTheWashDoes) {
  if (!hasKnob("ink.shown") || !hasKnob("watercolor.margin")) GTEST_SKIP() << "built without one of both";
  constexpr int kAcross = 160, kDown = 120;
  // Bars across the picture, whose edges are lines.
  TestScene s;
  const int board = s.material(TestScene::unlit("Board", {1, 1, 1, 1}));
  for (float y = -0.9f; y < 1; y += 0.3f) s.add(gridMesh({-9, y, 0}, {18, 0, 0}, {0, 0.15f, 0}), board);
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 5}, {0, 0, 0}, 22.6f, 0, 0.02f}, kAcross, kDown, GetParam());
  const Knobs drawn =
      plainWash({{"ink.shown", "on"}, {"ink.least", "20"}, {"ink.greatest", "20"}, {"ink.fade", "0"}});
  const auto inkOf = [&](const char* margin, bool isPainted) {
    Knobs knobs = drawn;
    knobs.push_back({"watercolor.margin", margin});
    knobs.push_back({"watercolor.shown", isPainted ? "on" : "off"});
    return draw(scene, quietLook(knobs), views, sized(kAcross, kDown));
  };
  const Frame with = inkOf("0.08", true), without = inkOf("0", true), plain = inkOf("0.08", false);
  for (size_t v = 0; v < viewCount(); ++v) {
    double beyond[3]{}, within[3]{};
    const Frame* const frames[] = {&with, &without, &plain};
    for (int i = 0; i < 3; ++i)
      for (int y = 0; y < kDown; ++y)
        for (int x = 0; x < kAcross; ++x) {
          const int side = std::min(std::min(x, kAcross - 1 - x), std::min(y, kDown - 1 - y));
          const double dark = 1 - texel(aov(*frames[i], "", v), x, y).x;
          if (side < 2) beyond[i] += dark;
          if (side > 0.35 * kDown) within[i] += dark;
        }
    EXPECT_LT(beyond[0], 0.5);
    EXPECT_GT(beyond[1], 20);
    EXPECT_GT(beyond[2], 20);
    EXPECT_GT(within[0], 100);
    EXPECT_NEAR(within[0], within[1], 1);
  }
}

}  // namespace
}  // namespace scumble
