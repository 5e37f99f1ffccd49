// Shadow shapes against the same in double precision, from the `blur`, `shadow`, `warp` and `depth` AOVs.
#include <algorithm>
#include <cmath>

#include "tests/support/aov.h"
#include "tests/support/render_test.h"

namespace scumble::passes {
namespace {

using namespace test;

struct Knobs {
  double threshold = 0.5, softness = 1, innerGlow = 0.16, indication = 0.55;
  int steps = 2;
  double radius = 60, depthEdge = 0.03;
  double dither = 0;
};

class FinalShadowTest : public BothEyes {
 protected:
  static constexpr int kWidth = 160, kHeight = 120;

  static Look lookOf(const Knobs& k) {
    return quietLook({{"shadow.threshold", std::to_string(k.threshold)},
                      {"shadow.softness", std::to_string(k.softness)},
                      {"shadow.innerGlow", std::to_string(k.innerGlow)},
                      {"shadow.indication", std::to_string(k.indication)},
                      {"shadow.indicationSteps", std::to_string(k.steps)},
                      {"shadow.dither", std::to_string(k.dither)},
                      {"blur.radius", std::to_string(k.radius)},
                      {"blur.depthEdge", std::to_string(k.depthEdge)}});
  }

  static glm::dvec4 expected(const Knobs& k, const Frame& frame, const Texels& blur, size_t view, int x,
                             int y) {
    const glm::dvec4 own = texel(aov(frame, "shadow", view), x, y);
    if (own.w == 0) return glm::dvec4(0.0);
    const double depth = std::min(texel(aov(frame, "depth", view), x, y).x, 60000.0);
    const double marks = texel(aov(frame, "warp", view), x, y).z;

    // The four blurred texels around the pixel, by distance, coverage and depth.
    const glm::dvec2 at = (glm::dvec2(x, y) + 0.5) / 4.0 - 0.5, corner = glm::floor(at), f = at - corner;
    const double sharpness = k.depthEdge > 0 ? 0.5 / (k.depthEdge * k.depthEdge) : 0;
    double lights[4], sum = 0, weights = 1e-6;
    for (int i = 0; i < 4; ++i) {
      const glm::dvec4 b = blur.clamped(int(corner.x) + (i & 1), int(corner.y) + (i >> 1));
      lights[i] = b.x * std::min(1.0, b.w / 1e-3);
      const double z = (b.z - depth) / depth, falloff = 1 / (1 + sharpness * z * z);
      const double side = (i & 1 ? f.x : 1 - f.x) * (i >> 1 ? f.y : 1 - f.y);
      const double weight = side * falloff * falloff * b.w;
      sum += weight * lights[i], weights += weight;
    }
    const double amount = std::min(0.5 * k.radius * kHeight / 1080 / 2, 1.0);
    // Where hardly any lies at the pixel's depth, its own light stands.
    const double light = glm::mix(own.x, sum / weights, amount * std::min(8 * weights, 1.0));

    // Threshold: as wide as the slope needs for `softness` pixels.
    const glm::dvec2 slope = 0.25 * glm::dvec2(glm::mix(lights[1] - lights[0], lights[3] - lights[2], f.y),
                                               glm::mix(lights[2] - lights[0], lights[3] - lights[1], f.x));
    const double width = std::max({0.5 * k.softness * glm::length(slope), 1e-3, 0.05 * k.dither});
    const double dithered = light - k.dither * (0.5 - marks);
    double lit = smoothstep(k.threshold - width, k.threshold + width, dithered);
    // Indication.
    if (own.z > 0) {
      double pushed = 0;
      for (int i = 1; i <= k.steps; ++i)
        pushed += std::clamp(0.5 + 25 * (light + own.z * marks * k.indication - k.threshold -
                                         0.9 * k.indication * i / k.steps),
                             0.0, 1.0);
      lit = std::max(lit, pushed * std::clamp(6 * light, 0.0, 1.0) / k.steps);
    }
    // Inner glow.
    lit += (1 - lit) * k.innerGlow * std::clamp(1 - light / k.threshold, 0.0, 1.0);
    return {lit, own.y, own.z, own.w};
  }
};
INSTANTIATE_BOTH_EYES(FinalShadowTest);

TEST_P(FinalShadowTest, equalsItsReference) {
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
  Knobs soft;
  soft.threshold = 0.3, soft.softness = 12, soft.innerGlow = 0.8, soft.indication = 1, soft.steps = 5;
  Knobs sharp;
  sharp.radius = 4, sharp.indication = 0, sharp.depthEdge = 0;
  Knobs dry;
  dry.dither = 0.6, dry.radius = 40;
  for (const Knobs& k : {Knobs(), soft, sharp, dry}) {
    const Frame frame = draw(scene, lookOf(k), views,
                             sized(kWidth, kHeight, {"shadow", "warp", "depth", "blur", "final-shadow"}));
    for (size_t v = 0; v < viewCount(); ++v) {
      const Texels blur = quarterTexels(aov(frame, "blur", v));
      // Where the light is flat the threshold is 2e-3 wide, which makes 750 times what half floats round
      // (1e-4): few pixels stand on that edge.
      Difference light(0.012), others(2.5e-3);  // 8 bits
      size_t lit = 0, dark = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const glm::dvec4 e = expected(k, frame, blur, v, x, y);
          const glm::dvec4 g = texel(aov(frame, "final-shadow", v), x, y);
          light.add(g.x, e.x);
          for (int c = 1; c < 4; ++c) others.add(g[c], e[c]);
          if (e.w > 0) ++(e.x > 0.5 ? lit : dark);
        }
      EXPECT_GT(lit, 1000u);  // the scene shows both
      EXPECT_GT(dark, 50u);
      EXPECT_LT(light.beyondPart(), 2e-3) << light.text() << ", threshold " << k.threshold;
      EXPECT_LT(light.mean(), 2e-3) << light.text();
      EXPECT_EQ(others.beyond, 0u) << others.text();
    }
  }
}

// FORMULAS 15: an edge is about `softness` pixels wide, however round the shapes are.
TEST_F(FinalShadowTest, edgesAreAsWideAsAskedFor) {
  TestScene s;
  s.add(gridMesh({-8, -3, 0}, {8, 0, 0}, {0, 6, 0}), s.material(TestScene::unlit("Bright", {1, 1, 1, 1})));
  s.add(gridMesh({0, -3, 0}, {8, 0, 0}, {0, 6, 0}), s.material(TestScene::colored("Dark", {1, 1, 1, 1})));
  s.light({0, 0.2f, -1});
  const Scene scene = s.load();
  for (const double radius : {100.0, 128.0})
    for (const double softness : {1.0, 4.0}) {
      Knobs k;
      k.radius = radius, k.softness = softness, k.innerGlow = 0, k.indication = 0;
      const Frame frame =
          draw(scene, lookOf(k), {parallelView(1, 4.0f / 3)}, sized(kWidth, kHeight, {"final-shadow"}));
      double between = 0;
      for (int x = 0; x < kWidth; ++x) {
        const double light = texel(aov(frame, "final-shadow"), x, kHeight / 2).x;
        between += light > 0.02 && light < 0.98;
      }
      EXPECT_GE(between, std::floor(0.6 * softness)) << "radius " << radius << ", softness " << softness;
      EXPECT_LE(between, std::ceil(softness) + 1) << "radius " << radius << ", softness " << softness;
    }
}

}  // namespace
}  // namespace scumble::passes
