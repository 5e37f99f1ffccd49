// FORMULAS 14: the colour is the mix of shadowed and lit by the final shadow, in the air, over the sky;
// against the same in double precision, from the AOVs of the passes before.
#include "passes/color/color.h"

#include <algorithm>
#include <cmath>

#include "tests/support/aov.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"

namespace scumble::passes {
namespace {

using namespace test;

class ColorTest : public BothEyes {
 protected:
  static constexpr int kWidth = 160, kHeight = 120;

  static void compare(const Scene& scene, const Look& look, const BackgroundParams& knobs,
                      const std::vector<View>& views, bool transparent) {
    RenderOptions options = sized(kWidth, kHeight, {"final-shadow", "lit", "shadowed", "depth", "color"});
    options.transparent = transparent;
    const Frame frame = draw(scene, look, views, options);
    const SceneSummary summary = scene.summary();
    const glm::dvec3 low(summary.min[0], summary.min[1], summary.min[2]);
    const glm::dvec3 high(summary.max[0], summary.max[1], summary.max[2]);
    const double radius = 0.5 * glm::length(high - low);
    const glm::dvec3 eye(glm::inverse(glm::dmat4(views[0].worldToEye))[3]);
    const double center = glm::length(0.5 * (low + high) - eye);
    const glm::dvec3 horizon(glm::vec3(knobs.horizon)), zenith(glm::vec3(knobs.zenith));
    for (size_t v = 0; v < views.size(); ++v) {
      // Half floats round by 2^-12 of up to 1, twice.
      Difference difference(1e-3);
      size_t seenSky = 0, mixed = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const glm::dvec4 lit = texel(aov(frame, "lit", v), x, y);
          const glm::dvec4 shadowed = texel(aov(frame, "shadowed", v), x, y);
          const double light = texel(aov(frame, "final-shadow", v), x, y).x;
          glm::dvec3 color = glm::mix(glm::dvec3(shadowed), glm::dvec3(lit), light);
          const double distance = texel(aov(frame, "depth", v), x, y).x;
          const double air = knobs.air * smoothstep(center + knobs.airStart * radius,
                                                    center + knobs.airEnd * radius, std::min(distance, 1e30));
          color = glm::mix(color, horizon, air);
          const double sine = pixelRay(views[v], x, y, kWidth, kHeight).direction.y;
          const double rise = smoothstep(0, std::sin(glm::radians(double(knobs.height))), sine);
          if (lit.w == 0) {
            color = transparent ? glm::dvec3(0.0) : glm::mix(horizon, zenith, rise);
            seenSky += rise > 0.01 && rise < 0.99;
          } else {
            mixed += air > 0.05 && air < 0.95;
          }
          const glm::dvec4 got = texel(aov(frame, "color", v), x, y);
          for (int c = 0; c < 3; ++c) difference.add(got[c], color[c]);
          EXPECT_EQ(got.w, transparent ? lit.w : 1.0);
        }
      EXPECT_EQ(difference.beyond, 0u) << difference.text() << ", view " << v;
      EXPECT_GE(seenSky, transparent ? 0u : 500u);
      EXPECT_GE(mixed, knobs.air > 0 ? 300u : 0u);
    }
  }
};
INSTANTIATE_BOTH_EYES(ColorTest);

TEST_P(ColorTest, equalsItsReference) {
  const Scene scene = stillLife().load();
  auto views = viewsFrom(scene, {{2, 1.5f, 6}, {0, 1.4f, 0}, 60}, kWidth, kHeight, GetParam());
  // Headsets have off-centre projections.
  for (size_t v = 0; v < views.size(); ++v)
    views[v].eyeToClip[2][0] = v == 0 ? 0.15f : -0.2f, views[v].eyeToClip[2][1] = 0.1f;
  BackgroundParams knobs;
  knobs.air = 0;
  compare(scene, quietLook(), knobs, views, false);
  compare(scene, quietLook(), knobs, views, true);
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

}  // namespace
}  // namespace scumble::passes
