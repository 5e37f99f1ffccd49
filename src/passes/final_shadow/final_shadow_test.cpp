// Shadow shapes against the same in double precision, from the `blur`, `shadow`, `warp` and `depth` AOVs.
#include <algorithm>
#include <cmath>

#include "tests/support/aov.h"
#include "tests/support/render_test.h"

namespace scumble::passes {
namespace {

using namespace test;

struct ShadowKnobs {
  double threshold = 0.5, softness = 1, innerGlow = 0.16, indication = 0.55;
  int steps = 2;
  double radius = 60, depthEdge = 0.03;
  double dither = 0;
  int bands = 1;
  double spacing = 0.2, glowWidth = 1;
};

// Edges between light and shadow: around the threshold, nearer to each other where light or shadow would end.
std::vector<double> edgesOf(const ShadowKnobs& k) {
  std::vector<double> edges;
  const double room = std::min(k.threshold - 0.02, 0.98 - k.threshold);
  for (int i = 0; i < k.bands; ++i) {
    const double place = k.bands > 1 ? 2.0 * i / (k.bands - 1) - 1 : 0;  // -1 to 1
    edges.push_back(k.threshold + place * std::min(room, 0.5 * k.spacing * (k.bands - 1)));
  }
  return edges;
}

// How far below `begin` the light is, as a part of it, at `width` of the way from a straight edge to where
// its blur ends, which is cut off at two deviations: by summing the blur's weights.
double reachOf(double width, double begin) {
  constexpr int kSteps = 40000;
  std::vector<double> light(kSteps + 1);  // from the end of the dark to the end of the light
  for (int i = 0; i < kSteps; ++i) {
    const double x = -2 + 4 * (i + 0.5) / kSteps;
    light[size_t(i) + 1] = light[size_t(i)] + std::exp(-0.5 * x * x);
  }
  const auto edge = std::lower_bound(light.begin(), light.end(), begin * light.back()) - light.begin();
  return 1 - light[size_t(std::lround(double(edge) * (1 - width)))] / light.back() / begin;
}

class FinalShadowTest : public BothEyes {
 protected:
  static constexpr int kWidth = 160, kHeight = 120;

  static Look lookOf(const ShadowKnobs& k) {
    return quietLook({{"shadow.threshold", std::to_string(k.threshold)},
                      {"shadow.softness", std::to_string(k.softness)},
                      {"shadow.innerGlow", std::to_string(k.innerGlow)},
                      {"shadow.indication", std::to_string(k.indication)},
                      {"shadow.indicationSteps", std::to_string(k.steps)},
                      {"shadow.dither", std::to_string(k.dither)},
                      {"shadow.steps", std::to_string(k.bands)},
                      {"shadow.stepSpacing", std::to_string(k.spacing)},
                      {"shadow.glowWidth", std::to_string(k.glowWidth)},
                      {"blur.radius", std::to_string(k.radius)},
                      {"blur.depthEdge", std::to_string(k.depthEdge)}});
  }

  static glm::dvec4 expected(const ShadowKnobs& k, const Frame& frame, const Texels& blur, double reach,
                             size_t view, int x, int y) {
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
    double steepness = glm::length(slope);
    if (amount < 1) {
      // The part that is not blurred has its own slope, on the steeper side.
      const auto step = [&](int dx, int dy) {
        const int i = std::clamp(x + dx, 0, kWidth - 1), j = std::clamp(y + dy, 0, kHeight - 1);
        const glm::dvec4 there = texel(aov(frame, "shadow", view), i, j);
        return there.w > 0 ? std::abs(there.x - own.x) : 0.0;
      };
      steepness = glm::mix(
          glm::length(glm::dvec2(std::max(step(-1, 0), step(1, 0)), std::max(step(0, -1), step(0, 1)))),
          steepness, amount);
    }
    const double width = std::max({0.5 * k.softness * steepness, 1e-3, 0.05 * k.dither});
    const double dithered = light - k.dither * (0.5 - marks);
    const std::vector<double> edges = edgesOf(k);
    double lit = 0;
    for (const double edge : edges) lit += smoothstep(edge - width, edge + width, dithered) / k.bands;
    // Indication.
    double dark = 0, bright = 0;
    for (int i = 1; i <= k.steps; ++i) {
      const double least = 1 - own.z * k.indication * i / k.steps, mark = 2 * marks - 1;
      dark += std::clamp(12 * (mark - least), 0.0, 1.0) / k.steps;
      bright += std::clamp(12 * (-mark - least), 0.0, 1.0) / k.steps;
    }
    bright *= std::clamp(6 * light, 0.0, 1.0);
    lit = std::min(std::max(lit, bright / k.bands), 1 - dark / k.bands);
    // Inner glow.
    const double inside = (1 - light / edges[0]) / reach;
    const double glow = (1 - lit) * k.innerGlow * std::clamp(inside, 0.0, 1.0);
    return {lit + glow, own.y, glow, own.w};
  }
};
INSTANTIATE_BOTH_EYES(FinalShadowTest);

TEST_P(FinalShadowTest, equalsItsReference) {
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
  ShadowKnobs soft;
  soft.threshold = 0.3, soft.softness = 12, soft.innerGlow = 0.8, soft.indication = 1, soft.steps = 5;
  ShadowKnobs sharp;
  sharp.radius = 4, sharp.indication = 0, sharp.depthEdge = 0;
  ShadowKnobs dry;
  dry.dither = 0.6, dry.radius = 40;
  ShadowKnobs bands;
  bands.bands = 3, bands.innerGlow = 0.7, bands.glowWidth = 0.4, bands.dither = 0.2;
  ShadowKnobs crowded;
  crowded.bands = 4, crowded.threshold = 0.3, crowded.spacing = 0.5, crowded.glowWidth = 0.8;
  for (const ShadowKnobs& k : {ShadowKnobs(), soft, sharp, dry, bands, crowded}) {
    const Frame frame = draw(scene, lookOf(k), views,
                             sized(kWidth, kHeight, {"shadow", "warp", "depth", "blur", "final-shadow"}));
    for (size_t v = 0; v < viewCount(); ++v) {
      const Texels blur = quarterTexels(aov(frame, "blur", v));
      const double reach = reachOf(k.glowWidth, edgesOf(k)[0]);
      // Where the light is flat the threshold is 2e-3 wide, which makes 750 times what half floats round
      // (1e-4): few pixels stand on that edge.
      Difference light(0.012), others(2.5e-3), glow(0.012);  // 8 bits
      size_t lit = 0, dark = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const glm::dvec4 e = expected(k, frame, blur, reach, v, x, y);
          const glm::dvec4 g = texel(aov(frame, "final-shadow", v), x, y);
          light.add(g.x, e.x);
          glow.add(g.z, e.z);
          for (const int c : {1, 3}) others.add(g[c], e[c]);
          if (e.w > 0) ++(e.x > 0.5 ? lit : dark);
        }
      EXPECT_GT(lit, 1000u);  // the scene shows both
      EXPECT_GT(dark, 50u);
      EXPECT_LT(light.beyondPart(), 2e-3) << light.text() << ", threshold " << k.threshold;
      EXPECT_LT(light.mean(), 2e-3) << light.text();
      EXPECT_LT(glow.beyondPart(), 2e-3) << glow.text();
      EXPECT_EQ(others.beyond, 0u) << others.text();
    }
  }
}

// At silhouettes light and lens are those of what is there, however little of the pixel it covers.
TEST_P(FinalShadowTest, partlyCoveredPixelsAreAsLitAsWholeOnes) {
  TestScene s;
  Json lamp = TestScene::unlit("Lamp", {1, 1, 1, 1});
  lamp["emissiveFactor"] = {0.6, 0.6, 0.6};
  s.add(gridMesh({-1, -0.8f, 0}, {1.7f, 0.5f, 0}, {-0.4f, 1.3f, 0}), s.material(lamp));
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 4}}, kWidth, kHeight, GetParam());
  ShadowKnobs k;
  k.radius = 0;
  const Frame frame = draw(scene, lookOf(k), views, sized(kWidth, kHeight, {"final-shadow"}, 4));
  for (size_t v = 0; v < viewCount(); ++v) {
    size_t partly = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const glm::dvec4 got = texel(aov(frame, "final-shadow", v), x, y);
        if (got.w == 0) continue;
        partly += got.w < 1;
        EXPECT_EQ(got.x, 1) << x << ", " << y;
        EXPECT_NEAR(got.y, 0.6, 3.0 / 255);  // 8 bits of a quarter of it, and again
      }
    EXPECT_GT(partly, 50u);
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
      ShadowKnobs k;
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

// A sphere whose light is not blurred: what lies between two edges is one flat level, and as large as the
// light says.
TEST_P(FinalShadowTest, bandsAreFlatAndAsLargeAsTheirSharesOfTheLight) {
  TestScene s;
  s.add(sphereMesh({0, 0, 0}, 1, 96), s.material(TestScene::colored("Grey", {0.5f, 0.5f, 0.5f, 1})));
  s.light({-0.8f, 0.5f, 0.3f});
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0.3f, 0.5f, 3}}, kWidth, kHeight, GetParam());
  for (const int count : {1, 2, 3, 4}) {
    ShadowKnobs k;
    k.bands = count, k.radius = 0, k.innerGlow = 0, k.indication = 0;
    Look look = lookOf(k);
    ASSERT_TRUE(look.set("light.terminatorSharpness", "0.5"));
    ASSERT_TRUE(look.set("shadowMap.cast", "off"));
    const Frame frame = draw(scene, look, views, sized(kWidth, kHeight, {"shadow", "final-shadow"}));
    const std::vector<double> edges = edgesOf(k);
    for (size_t v = 0; v < viewCount(); ++v) {
      std::vector<int> area(size_t(count) + 1), wanted(size_t(count) + 1);
      int between = 0, all = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const glm::dvec4 own = texel(aov(frame, "shadow", v), x, y);
          if (own.w == 0) continue;
          const double level = texel(aov(frame, "final-shadow", v), x, y).x * count;
          const double nearest = std::round(level);
          ++all;
          if (std::abs(level - nearest) < 0.02)
            ++area[size_t(nearest)];
          else
            ++between;
          ++wanted[size_t(std::count_if(edges.begin(), edges.end(), [&](double e) { return own.x > e; }))];
        }
      EXPECT_GT(all, 3000);
      EXPECT_LT(between, all / 15 * count);
      for (size_t i = 0; i < area.size(); ++i) {
        EXPECT_GT(area[i], 100) << "level " << i << " of " << count;
        EXPECT_NEAR(area[i], wanted[i], between + 0.01 * all) << "level " << i << " of " << count;
      }
    }
  }
}

// However wide and strong: nothing of it in the light, in bands, or at their edges; all of it in the dark.
TEST_P(FinalShadowTest, theGlowStaysInsideTheDark) {
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
  for (const auto& [count, width, samples] :
       {std::tuple(1, 0.05, 1u), {1, 0.5, 1u}, {1, 1.0, 4u}, {3, 0.05, 4u}, {3, 0.5, 1u}, {3, 1.0, 1u}}) {
    ShadowKnobs k;
    k.bands = count, k.innerGlow = 0, k.glowWidth = width, k.indication = 0;
    const Frame without = draw(scene, lookOf(k), views, sized(kWidth, kHeight, {"final-shadow"}, samples));
    k.innerGlow = 1;
    const Frame with = draw(scene, lookOf(k), views, sized(kWidth, kHeight, {"final-shadow"}, samples));
    for (size_t v = 0; v < viewCount(); ++v) {
      size_t glowing = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const glm::dvec4 before = texel(aov(without, "final-shadow", v), x, y);
          const glm::dvec4 after = texel(aov(with, "final-shadow", v), x, y);
          EXPECT_GE(after.x, before.x);
          // At the middle of the darkest edge the light is half a step. Of several samples some may lie in
          // the dark.
          if (before.x > (samples > 1 ? 0.999 : 0.51 / count)) {
            EXPECT_EQ(after.x, before.x) << x << ", " << y;
            EXPECT_EQ(after.z, 0) << x << ", " << y;
          }
          glowing += after.z > 0.9;
        }
      EXPECT_GT(glowing, 20u) << "width " << width << ", " << count << " steps";
    }
  }
}

// Each of several edges is hard and as wide as asked for, and light only grows towards the light.
TEST_F(FinalShadowTest, severalEdgesAreAsContinuousAsOne) {
  TestScene s;
  s.add(gridMesh({-8, -3, 0}, {8, 0, 0}, {0, 6, 0}), s.material(TestScene::unlit("Bright", {1, 1, 1, 1})));
  s.add(gridMesh({0, -3, 0}, {8, 0, 0}, {0, 6, 0}), s.material(TestScene::colored("Dark", {1, 1, 1, 1})));
  s.light({0, 0.2f, -1});
  const Scene scene = s.load();
  constexpr int kLarge = 480;
  for (const int count : {2, 3, 4}) {
    ShadowKnobs k;
    k.bands = count, k.radius = 128, k.softness = 2, k.innerGlow = 0, k.indication = 0;
    const Frame frame = draw(scene, lookOf(k), {parallelView(1, 1)}, sized(kLarge, kLarge, {"final-shadow"}));
    int between = 0;
    for (int x = 1; x < kLarge; ++x) {
      const double light = texel(aov(frame, "final-shadow"), x, kLarge / 2).x;
      EXPECT_LE(light, texel(aov(frame, "final-shadow"), x - 1, kLarge / 2).x + 0.01);
      between += std::abs(light * count - std::round(light * count)) > 0.03;
    }
    EXPECT_GE(between, count);
    EXPECT_LE(between, 3 * count);
  }
}

// Indication breaks up what is oblique to the light, and nothing else.
TEST_P(FinalShadowTest, indicationActsOnlyWhereTheLightIsOblique) {
  TestScene s;
  s.add(sphereMesh({0, 0, 0}, 1, 96), s.material(TestScene::colored("Grey", {0.5f, 0.5f, 0.5f, 1})));
  const glm::dvec3 toLight = glm::normalize(glm::dvec3(-0.6, 0.5, 0.5));
  s.light(glm::vec3(toLight));
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0.3f, 0.5f, 3}}, kWidth, kHeight, GetParam());
  Frame frames[2];
  for (const int on : {0, 1}) {
    ShadowKnobs k;
    k.indication = on, k.radius = 9;
    Look look = lookOf(k);
    ASSERT_TRUE(look.set("light.terminator", "0.1"));
    ASSERT_TRUE(look.set("surface.indicationWidth", "0.3"));
    frames[on] = draw(scene, look, views, sized(kWidth, kHeight, {"final-shadow", "normal", "id"}));
  }
  for (size_t v = 0; v < viewCount(); ++v) {
    size_t changed = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        if (texel(aov(frames[0], "id", v), x, y).x == 0) continue;
        const double turn = glm::dot(glm::dvec3(texel(aov(frames[0], "normal", v), x, y)), toLight) - 0.1;
        const bool differs = texel(aov(frames[0], "final-shadow", v), x, y).x !=
                             texel(aov(frames[1], "final-shadow", v), x, y).x;
        changed += differs;
        // Triangles of 4 degrees stand for the sphere.
        EXPECT_FALSE(differs && std::abs(turn) > 0.302) << x << ", " << y << ", turned by " << turn;
      }
    EXPECT_GT(changed, 50u);
  }
}

// Marks lie on both sides of the edge, the denser the nearer to it, and change enough of a form to be seen.
TEST_P(FinalShadowTest, indicationBreaksTheTransitionUpOnBothSides) {
  TestScene s;
  s.add(sphereMesh({0, 0, 0}, 1, 96), s.material(TestScene::colored("Grey", {0.5f, 0.5f, 0.5f, 1})));
  const glm::dvec3 toLight = glm::normalize(glm::dvec3(-0.9, 0.5, 0.2));
  s.light(glm::vec3(toLight));
  const Scene scene = s.load();
  constexpr int kLargeWidth = 320, kLargeHeight = 240;
  const auto views = viewsFrom(scene, {{0.3f, 0.5f, 3}}, kLargeWidth, kLargeHeight, GetParam());
  Frame frames[2];
  for (const int on : {0, 1}) {
    ShadowKnobs k;
    k.indication = on, k.radius = 9, k.innerGlow = 0;
    frames[on] =
        draw(scene, lookOf(k), views, sized(kLargeWidth, kLargeHeight, {"final-shadow", "normal", "id"}));
  }
  for (size_t v = 0; v < viewCount(); ++v) {
    size_t all = 0, darker[3] = {}, lighter = 0, there[3] = {};
    for (int y = 0; y < kLargeHeight; ++y)
      for (int x = 0; x < kLargeWidth; ++x) {
        if (texel(aov(frames[0], "id", v), x, y).x != 1) continue;
        ++all;
        const double turn = glm::dot(glm::dvec3(texel(aov(frames[0], "normal", v), x, y)), toLight) - 0.1;
        const double change = texel(aov(frames[1], "final-shadow", v), x, y).x -
                              texel(aov(frames[0], "final-shadow", v), x, y).x;
        lighter += change > 0.1 && turn < 0;
        // Thirds of how far they reach into the light.
        if (turn < 0.02 || turn >= 0.35) continue;
        const auto third = size_t(turn / 0.35 * 3);
        darker[third] += change < -0.1, ++there[third];
      }
    EXPECT_GT(double(darker[0] + darker[1] + darker[2] + lighter), 0.02 * double(all));
    EXPECT_GT(lighter, 20u);
    const auto part = [&](size_t third) { return double(darker[third]) / double(there[third]); };
    EXPECT_GT(part(0), 1.5 * part(1));
    EXPECT_GT(part(1), 1.5 * part(2));
  }
}

TEST_P(FinalShadowTest, fragmentAndComputeAgree) {
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
  ShadowKnobs k;
  k.bands = 3, k.glowWidth = 0.5;
  Look look = lookOf(k);
  ASSERT_TRUE(look.set("shadow.glowColorAmount", "1"));
  const RenderOptions options = sized(kWidth, kHeight, {"final-shadow", "color"}, 4);
  const Frame a = draw(scene, look, views, options);
  const Frame b = otherRenderer().render(scene, look, 0, views, options).value();
  for (size_t v = 0; v < viewCount(); ++v) {
    EXPECT_LE(largestDifference(aov(a, "final-shadow", v), aov(b, "final-shadow", v)), 1.001 / 255);
    EXPECT_LT(largestDifference(aov(a, "color", v), aov(b, "color", v)), 5e-3);
  }
}

}  // namespace
}  // namespace scumble::passes
