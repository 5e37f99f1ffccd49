// FORMULAS 14: the colour is the mix of shadowed and lit by the final shadow, in the air, over the sky;
// against the same in double precision, from the AOVs of the passes before.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "passes/color/color_knobs.h"
#include "tests/support/aov.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"

namespace scumble::passes {
namespace {

using namespace test;

class ColorTest : public BothEyes {
 protected:
  static constexpr int kWidth = 160, kHeight = 120;

  // Whether neighbours have other colours or light.
  static bool isBesideOthers(const Frame& frame, size_t v, int x, int y) {
    for (const char* name : {"lit", "shadowed", "final-shadow"})
      for (const glm::ivec2& side : {glm::ivec2(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
        const glm::ivec2 at =
            glm::clamp(glm::ivec2(x, y) + side, glm::ivec2(0), glm::ivec2(kWidth - 1, kHeight - 1));
        const glm::dvec4 apart = texel(aov(frame, name, v), x, y) - texel(aov(frame, name, v), at.x, at.y);
        for (int c = 0; c < 4; ++c)
          if (std::abs(apart[c]) > 0.01) return true;
      }
    return false;
  }

  static void compare(const Scene& scene, const Look& look, const BackgroundParams& knobs,
                      const std::vector<View>& views, bool transparent, uint32_t samples = 1) {
    RenderOptions options =
        sized(kWidth, kHeight, {"final-shadow", "lit", "shadowed", "depth", "color"}, samples);
    options.transparent = transparent;
    const Frame frame = draw(scene, look, views, options);
    const SceneSummary summary = scene.summary();
    const glm::dvec3 low(summary.min[0], summary.min[1], summary.min[2]);
    const glm::dvec3 high(summary.max[0], summary.max[1], summary.max[2]);
    const double radius = 0.5 * glm::length(high - low);
    glm::dvec3 eye(0.0);  // between the eyes
    for (const View& view : views)
      eye += glm::dvec3(glm::inverse(glm::dmat4(view.worldToEye))[3]) / double(views.size());
    const double center = glm::length(0.5 * (low + high) - eye);
    const glm::dvec3 horizon(glm::vec3(knobs.horizon)), zenith(glm::vec3(knobs.zenith));
    for (size_t v = 0; v < views.size(); ++v) {
      // Half floats round by 2^-12 of up to 1, twice.
      Difference difference(1.5e-3);
      size_t seenSky = 0, mixed = 0, partly = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const glm::dvec4 lit = texel(aov(frame, "lit", v), x, y);
          const glm::dvec4 shadowed = texel(aov(frame, "shadowed", v), x, y);
          const double light = texel(aov(frame, "final-shadow", v), x, y).x;
          glm::dvec3 color = glm::mix(glm::dvec3(shadowed), glm::dvec3(lit), light);
          const double distance = texel(aov(frame, "depth", v), x, y).x;
          // What has no depth has no distance, and no air before it.
          const double air = std::isinf(distance)
                                 ? 0.0
                                 : knobs.air * smoothstep(center + knobs.airStart * radius,
                                                          center + knobs.airEnd * radius, distance);
          color = glm::mix(color, horizon, air);
          const double sine = pixelRay(views[v], x, y, kWidth, kHeight).direction.y;
          const double rise = smoothstep(0, std::sin(glm::radians(double(knobs.height))), sine);
          const glm::dvec3 sky = glm::mix(horizon, zenith, rise);
          if (!transparent) color = glm::mix(sky, color, lit.w);
          if (lit.w == 0) {
            if (transparent) color = glm::dvec3(0.0);
            seenSky += rise > 0.01 && rise < 0.99;
          } else {
            mixed += air > 0.05 && air < 0.95;
          }
          partly += lit.w > 0 && lit.w < 1;
          const glm::dvec4 got = texel(aov(frame, "color", v), x, y);
          // What becomes of pixels with samples of several surfaces is another test's.
          if (samples == 1 || !isBesideOthers(frame, v, x, y))
            for (int c = 0; c < 3; ++c) difference.add(got[c], color[c]);
          // What several samples are resolved into has 8 bits, which devices round up or down.
          EXPECT_NEAR(got.w, transparent ? lit.w : 1.0, samples > 1 ? 1.0 / 255 + 5e-4 : 0.0);
        }
      EXPECT_GE(partly, samples > 1 ? 200u : 0u);
      EXPECT_EQ(difference.beyond, 0u) << difference.text() << ", view " << v;
      EXPECT_GE(seenSky, transparent ? 0u : 500u);
      EXPECT_GE(mixed, knobs.air > 0 ? 200u : 0u);
    }
  }
};
INSTANTIATE_BOTH_EYES(ColorTest);

TEST_P(ColorTest, equalsItsReference) {
  const Scene scene = stillLife().load();
  auto views = viewsFrom(scene, {{2, 1.5f, 6}, {0, 1.4f, 0}, 60}, kWidth, kHeight, GetParam());
  // Headsets have off-centre projections.
  const auto offCentre = [](std::vector<View>& of) {
    for (size_t v = 0; v < of.size(); ++v)
      of[v].eyeToClip[2][0] = v == 0 ? 0.15f : -0.2f, of[v].eyeToClip[2][1] = 0.1f;
  };
  offCentre(views);
  // One eye stands nearer than the other.
  if (views.size() > 1) views[1].worldToEye[3].z -= 0.8f;
  BackgroundParams knobs;
  knobs.air = 0;
  compare(scene, quietLook(), knobs, views, false);
  compare(scene, quietLook(), knobs, views, true);
  compare(scene, quietLook(), knobs, views, false, 4);
  compare(scene, quietLook(), knobs, views, true, 4);
  // Looking past the scene's centre, one eye is nearer to it than the other.
  views = viewsFrom(scene, {{2, 1.5f, 6}, {1.3f, 1.4f, 0}, 60, 0, 0.6f}, kWidth, kHeight, GetParam());
  offCentre(views);
  knobs.air = 0.8f, knobs.airStart = -0.5f, knobs.airEnd = 0.6f, knobs.height = 20;
  compare(
      scene,
      quietLook({{"background.air", "0.8"},
                 {"background.airStart", "0"},
                 {"background.airEnd", "0.6"},
                 {"background.height", "20"}}),
      [&] {
        BackgroundParams from = knobs;
        from.airStart = 0;
        return from;
      }(),
      views, false);
}

// A pixel with samples of several surfaces has the mean of their colours, each in its own light: that of
// pictures of one sample a pixel which are moved to where samples lie.
TEST_P(ColorTest, samplesOfSeveralSurfacesAreMeansOfTheirColors) {
  // Unlit things of strong colours before each other; and a dark one before a light wall, in shadow before
  // light.
  TestScene s;
  const glm::vec3 colors[] = {
      {0.9f, 0.05f, 0.02f}, {0.02f, 0.1f, 0.7f}, {0.9f, 0.8f, 0.1f}, {0.02f, 0.3f, 0.05f}};
  for (int i = 0; i < 12; ++i)
    s.add(sphereMesh({0.5f * float(i % 4) - 1, 0.3f * float(i % 5) + 0.5f, 0.7f * float(i % 3)}, 0.35f, 24),
          s.material(TestScene::unlit("Ball", glm::vec4(colors[i % 4], 1))));
  s.add(gridMesh({-5, -1, -2}, {10, 0, 0}, {0, 5, 0}),
        s.material(TestScene::colored("Wall", {0.9f, 0.9f, 0.8f, 1})));
  s.add(gridMesh({1.2f, 0, -1}, {0.4f, 0.1f, 0}, {0.1f, 2, 0}),
        s.material(TestScene::colored("Dark", {0.1f, 0.05f, 0.05f, 1})));
  s.light({0.1f, 0.2f, 1});
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0.4f, 1.5f, 6}, {0, 1.1f, 0}, 40}, kWidth, kHeight, GetParam());
  const Look look = quietLook({{"shadow.indication", "0"}});
  const Frame four = draw(scene, look, views, sized(kWidth, kHeight, {"color"}, 4));
  std::vector<Frame> ones;
  for (const glm::vec2& place :
       {glm::vec2(0.375f, 0.125f), {0.875f, 0.375f}, {0.125f, 0.625f}, {0.625f, 0.875f}}) {
    auto moved = views;
    for (View& view : moved) {
      const glm::vec2 offset = 2.0f * (0.5f - place) / glm::vec2(kWidth, kHeight);
      view.eyeToClip = glm::translate(glm::mat4(1.0f), glm::vec3(offset, 0)) * view.eyeToClip;
    }
    ones.push_back(draw(scene, look, moved, sized(kWidth, kHeight, {"color"})));
  }
  for (size_t v = 0; v < views.size(); ++v) {
    size_t mixed = 0;
    double off = 0, rootsOff = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        glm::dvec3 mean(0.0), rootMean(0.0), least(1e9), most(-1e9);
        for (const Frame& one : ones) {
          const glm::dvec3 color(texel(aov(one, "color", v), x, y));
          mean += 0.25 * color, rootMean += 0.25 * glm::sqrt(glm::max(color, 0.0));
          least = glm::min(least, color), most = glm::max(most, color);
        }
        if (glm::length(most - least) < 0.1) continue;
        ++mixed;
        const glm::dvec3 got(texel(aov(four, "color", v), x, y));
        off += glm::length(got - mean), rootsOff += glm::length(rootMean * rootMean - mean);
      }
    EXPECT_GT(mixed, 300u);
    // The edges of what they cast on the wall are found once a pixel.
    EXPECT_LT(off / double(mixed), 0.03) << "view " << v;
    EXPECT_GT(rootsOff, 3 * off) << "means of roots are no such means";
  }
}

// Bands lie at equal parts of value between shadow and light; the inner glow has a colour of its own.
TEST_P(ColorTest, bandsMixValuesAndTheGlowHasItsColor) {
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 1.5f, 6}, {0, 1.4f, 0}, 60}, kWidth, kHeight, GetParam());
  const double amount = 0.7;
  for (const bool bands : {false, true}) {
    const Look look = quietLook({{"shadow.steps", bands ? "3" : "1"},
                                 {"shadow.innerGlow", "0.8"},
                                 {"shadow.glowColor", "#FF8000"},
                                 {"shadow.glowColorAmount", std::to_string(amount)}});
    const Frame frame =
        draw(scene, look, views, sized(kWidth, kHeight, {"final-shadow", "lit", "shadowed", "color"}));
    const glm::dvec3 glowColor(1, std::pow((128 / 255.0 + 0.055) / 1.055, 2.4), 0);
    for (size_t v = 0; v < views.size(); ++v) {
      Difference difference(2e-3);
      size_t glowing = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const glm::dvec3 lit(texel(aov(frame, "lit", v), x, y));
          const glm::dvec3 shadowed(texel(aov(frame, "shadowed", v), x, y));
          if (texel(aov(frame, "lit", v), x, y).w == 0) continue;
          const glm::dvec4 light = texel(aov(frame, "final-shadow", v), x, y);
          const glm::dvec3 root = glm::mix(glm::sqrt(shadowed), glm::sqrt(lit), light.x);
          glm::dvec3 color = bands ? root * root : glm::mix(shadowed, lit, light.x);
          color += light.z * amount * (glowColor - lit);
          for (int c = 0; c < 3; ++c) difference.add(texel(aov(frame, "color", v), x, y)[c], color[c]);
          glowing += light.z > 0.3;
        }
      EXPECT_EQ(difference.beyond, 0u) << difference.text() << ", view " << v;
      EXPECT_GT(glowing, 100u);
    }
  }
}

// A parallel projection sees the sky in one direction only.
TEST_F(ColorTest, skyOfAParallelProjection) {
  const Scene scene = stillLife().load();
  BackgroundParams knobs;
  knobs.air = 0;
  const Frame frame =
      draw(scene, quietLook(), {parallelView(6, 4.0f / 3)}, sized(kWidth, kHeight, {"color", "lit"}));
  const glm::dvec3 horizon(glm::vec3(knobs.horizon));
  for (const int x : {1, kWidth - 2})
    for (const int y : {1, kHeight - 2}) {
      ASSERT_EQ(texel(aov(frame, "lit"), x, y).w, 0);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(texel(aov(frame, "color"), x, y)[c], horizon[c], 5e-4);
    }
}

// What is blended dissolves into the horizon at its own distance, also where nothing lies behind it.
TEST_P(ColorTest, panesAreInTheAirBeforeThem) {
  constexpr float kOpacity = 0.6f;
  const auto drawn = [&](const char* alphaMode, const char* air, bool isNear, uint32_t samples) {
    TestScene s;
    nlohmann::json pane = TestScene::unlit("Pane", {0.8f, 0.1f, 0.1f, kOpacity});
    pane["alphaMode"] = alphaMode;
    s.add(gridMesh({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), s.material(pane));
    // The air begins at the scene's centre: before the pane, or behind it.
    s.add(gridMesh({2, -1, isNear ? -40 : 4}, {1, 0, 0}, {0, 2, 0}),
          s.material(TestScene::colored("Other", glm::vec4(1))));
    const Scene scene = s.load();
    const Frame frame =
        draw(scene,
             quietLook({{"background.air", air}, {"background.airStart", "0"}, {"background.airEnd", "0.5"}}),
             viewsFrom(scene, {{0, 0, 9}}, kWidth, kHeight, GetParam()),
             sized(kWidth, kHeight, {"color"}, samples));
    std::vector<glm::dvec4> colors;
    for (size_t v = 0; v < viewCount(); ++v)
      colors.push_back(texel(aov(frame, "color", v), kWidth / 2, kHeight / 2));
    return colors;
  };
  for (const uint32_t samples : {1u, 4u}) {
    EXPECT_EQ(drawn("BLEND", "1", true, samples), drawn("BLEND", "0", true, samples));
    const auto clear = drawn("BLEND", "0", false, samples), through = drawn("BLEND", "1", false, samples),
               opaqueClear = drawn("OPAQUE", "0", false, samples),
               opaque = drawn("OPAQUE", "1", false, samples);
    for (size_t v = 0; v < viewCount(); ++v)
      for (int c = 0; c < 3; ++c) {
        // Of the sky as much as without air.
        const double sky = (clear[v][c] - kOpacity * opaqueClear[v][c]);
        EXPECT_NEAR(through[v][c], kOpacity * opaque[v][c] + sky, 0.01) << samples << " samples";
        if (c == 1) {
          EXPECT_GT(through[v][c] - clear[v][c], 0.1);
        }
      }
  }
}

// The automatic background goes by the mean of the scene's colours over its surface, as their square roots.
TEST_F(ColorTest, theAutomaticBackgroundGoesByTheMeanOverTheSurface) {
  const glm::dvec3 a(0.25, 0.12, 0.06), b(0.08, 0.14, 0.20);
  // Of a wall for each colour, `width` metres wide and a metre high by its node's scale.
  const auto skyOver = [](const std::vector<std::pair<glm::dvec3, float>>& walls, bool byVertices) {
    TestScene s;
    for (const auto& [color, width] : walls) {
      TestMesh mesh = gridMesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
      if (byVertices) mesh.colors.assign(4, glm::vec4(color, 1));
      s.add(mesh, s.material(TestScene::colored("Wall", byVertices ? glm::vec4(1) : glm::vec4(color, 1))),
            glm::scale(glm::mat4(1.0f), glm::vec3(width, 1, 1)));
    }
    const Frame frame = draw(s.load(), quietLook({{"background.mode", "auto"}}), {parallelView(6, 4.0f / 3)},
                             sized(16, 12, {"color", "lit"}));
    EXPECT_EQ(texel(aov(frame, "lit"), 1, 1).w, 0);
    return glm::dvec3(texel(aov(frame, "color"), 1, 1));
  };
  const auto mean = [&](double shareOfA) {
    const glm::dvec3 root = glm::mix(glm::sqrt(b), glm::sqrt(a), shareOfA);
    return root * root;
  };
  for (const bool byVertices : {false, true})
    for (const double share : {0.5, 0.75}) {
      const glm::dvec3 got = skyOver({{a, float(share)}, {b, float(1 - share)}}, byVertices),
                       expected = skyOver({{mean(share), 1.0f}}, false);
      // Vertex colours have 8 bits.
      EXPECT_LT(glm::length(got - expected), byVertices ? 0.01 : 1e-3) << "share " << share;
    }
  EXPECT_GT(glm::length(skyOver({{a, 1.0f}}, false) - skyOver({{b, 1.0f}}, false)), 0.05);
  EXPECT_GT(glm::length(skyOver({{mean(0.75), 1.0f}}, false) - skyOver({{mean(0.5), 1.0f}}, false)), 0.015);
}

}  // namespace
}  // namespace scumble::passes
