// Light space and its sigmoid against the CPU, and FORMULAS 13: what is straight casts a straight shadow.
#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support/aov.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"
#include "tests/support/sanitized.h"
#include "tests/support/test_device.h"

namespace scumble::passes {
namespace {

using namespace test;

class ShadowMapTest : public BothEyes {};
INSTANTIATE_BOTH_EYES(ShadowMapTest);

// Points that the light sees lie in the map where the sigmoid puts them, at their depth.
TEST_P(ShadowMapTest, pointsLieWhereTheSigmoidPutsThem) {
  const TestScene test = stillLife();
  const glm::dvec3 toLight = glm::normalize(glm::dvec3(-0.6, 1.0, 0.8));
  const Scene scene = test.load();
  const auto views = viewsFrom(scene, {{-0.4f, 1.6f, 1.4f}, {0, 0.8f, 0}}, 64, 48, GetParam());
  // Light axes and the box of everything in them, by its parts' boxes in the world.
  const glm::dvec3 right = glm::normalize(glm::cross(-toLight, glm::dvec3(0, 1, 0))),
                   up = glm::cross(right, -toLight);
  // y points down, as in clip space.
  const glm::dmat3 axes = glm::transpose(glm::dmat3(right, -up, -toLight));
  glm::dvec3 low(1e9), high(-1e9);
  for (int id = 1; id <= 4; ++id) {
    glm::dvec3 a(1e9), b(-1e9);
    for (const WorldTriangle& t : test.triangles())
      if (t.id == id)
        for (const glm::dvec3& p : t.positions) a = glm::min(a, p), b = glm::max(b, p);
    for (int i = 0; i < 8; ++i) {
      const glm::dvec3 p = axes * glm::dvec3(i & 1 ? b.x : a.x, i & 2 ? b.y : a.y, i & 4 ? b.z : a.z);
      low = glm::min(low, p), high = glm::max(high, p);
    }
  }
  const SceneSummary summary = scene.summary();
  const double radius =
      0.5 * glm::length(glm::dvec3(summary.max[0] - summary.min[0], summary.max[1] - summary.min[1],
                                   summary.max[2] - summary.min[2]));
  const glm::dvec3 half = 0.505 * (high - low) + 1e-4 * radius, center = 0.5 * (low + high);
  glm::dvec3 viewer(0.0);
  for (const View& view : views)
    viewer += glm::dvec3(glm::inverse(glm::dmat4(view.worldToEye))[3]) / double(views.size());
  const glm::dvec2 focus = glm::clamp(glm::dvec2((axes * viewer - center) / half), -1.0, 1.0);

  for (const double strength : {0.0, 1.0, 8.0, 16.0}) {
    const Frame frame = draw(scene, quietLook({{"light.shadowWarp", std::to_string(strength)}}), views,
                             sized(64, 48, {"shadow-map"}));
    const Image& map = aov(frame, "shadow-map");
    ASSERT_EQ(frame.layers.back().views.size(), 1u);  // one for all views
    const auto sigmoid = [](double t) { return t / std::sqrt(1 + t * t); };
    const auto warped = [&](double p, double at) {
      if (strength == 0) return p;
      const double a = sigmoid(strength * (-1 - at)), b = sigmoid(strength * (1 - at));
      // A quarter of the map is even.
      return 0.75 * ((sigmoid(strength * (p - at)) - a) / (b - a) * 2 - 1) + 0.25 * p;
    };
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(0, 1);
    size_t wrong = 0, count = 0;
    for (int tries = 0; tries < 60000 && count < 400; ++tries) {
      const WorldTriangle& t = test.triangles()[size_t(number(random) * double(test.triangles().size()))];
      double u = number(random), v = number(random);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const glm::dvec3 p =
          t.positions[0] + u * (t.positions[1] - t.positions[0]) + v * (t.positions[2] - t.positions[0]);
      if (glm::dot(glm::normalize(t.outward), toLight) < 0.3) continue;
      const glm::dvec3 q = (axes * p - center) / half;
      // Where the map is much coarser, a texel holds more than one surface.
      const double finer = std::min((warped(q.x + 1e-4, focus.x) - warped(q.x, focus.x)) / 1e-4,
                                    (warped(q.y + 1e-4, focus.y) - warped(q.y, focus.y)) / 1e-4);
      if (finer < 0.3) continue;
      if (castRay({p + 1e-4 * toLight, toLight}, test.triangles(), true)) continue;
      ++count;
      const int size = int(map.width);
      const int x = int((warped(q.x, focus.x) * 0.5 + 0.5) * size),
                y = int((warped(q.y, focus.y) * 0.5 + 0.5) * size);
      // A surface may lie three texels off its curve, and slope by three along the light: look around.
      double nearest = 1e9;
      for (int j = -3; j <= 3; ++j)
        for (int i = -3; i <= 3; ++i)
          nearest = std::min(nearest, std::abs(texel(map, x + i, y + j).x - (0.5 + 0.5 * q.z)));
      wrong += nearest > 2e-3;
    }
    EXPECT_GE(count, 200u) << "strength " << strength;
    EXPECT_LE(wrong, count / 50) << "strength " << strength;  // at silhouettes
  }
}

// FORMULAS 13: a pole on a ground of 100 m by 100 m, which is two triangles, casts one straight shadow.
TEST_P(ShadowMapTest, aPoleCastsAStraightShadow) {
  constexpr int kWidth = 320, kHeight = 240;
  TestScene test;
  const int sand = test.material(TestScene::colored("Sand", {0.6f, 0.5f, 0.3f, 1}));
  test.add(gridMesh({-50, 0, 50}, {100, 0, 0}, {0, 0, -100}), sand);
  test.add(boxMesh({-10.5f, 0, -5.5f}, {-9.5f, 15, -4.5f}), sand);
  const glm::dvec3 toLight = glm::normalize(glm::dvec3(-1.0, 0.6, -0.35));
  test.light(glm::vec3(toLight));
  const Scene scene = test.load();
  // The map is finest where the viewer stands in light space: beside the shadow.
  const glm::vec3 middle(3, 0, 0), eye = middle + 40.0f * glm::vec3(toLight) + glm::vec3(-4, 0, 12);
  const auto views = viewsFrom(scene, {eye, middle, 50}, kWidth, kHeight, GetParam());
  for (const double strength : {0.0, 1.0, 8.0, 16.0}) {
    const Frame frame =
        draw(scene,
             quietLook({{"light.shadowWarp", std::to_string(strength)}, {"light.terminatorSharpness", "8"}}),
             views, sized(kWidth, kHeight, {"shadow", "position", "id"}));
    for (size_t v = 0; v < viewCount(); ++v) {
      // Along the shadow and across it, metres from the pole's foot.
      const glm::dvec2 along = -glm::normalize(glm::dvec2(toLight.x, toLight.z)), across(-along.y, along.x);
      const double length = 15 * glm::length(glm::dvec2(toLight.x, toLight.z)) / toLight.y;
      std::vector<glm::dvec2> sums(24);  // of offset across, and of weight, in bins along the shadow
      double stray = 0, ground = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          if (texel(aov(frame, "id", v), x, y).x != 1) continue;
          const double dark = 1 - texel(aov(frame, "shadow", v), x, y).x;
          const glm::dvec3 p(texel(aov(frame, "position", v), x, y));
          const glm::dvec2 d = glm::dvec2(p.x + 10, p.z + 5);
          const double s = glm::dot(d, along), t = glm::dot(d, across);
          ground += 1;
          if (s > -1 && s < length + 1.5 && std::abs(t) < 1.5) {
            const size_t bin =
                size_t(std::clamp(s / length * double(sums.size()), 0.0, double(sums.size()) - 1));
            sums[bin] += glm::dvec2(t * dark, dark);
          } else {
            stray += dark;  // acne, or a bent shadow
          }
        }
      EXPECT_GT(ground, 20000);
      EXPECT_LT(stray, 1e-3 * ground) << "strength " << strength << ", view " << v;
      double most = 0;
      size_t missing = 0;
      for (size_t b = 1; b + 2 < sums.size(); ++b) {
        if (sums[b].y < 0.5)
          ++missing;
        else
          most = std::max(most, std::abs(sums[b].x / sums[b].y));
      }
      EXPECT_EQ(missing, 0u) << "strength " << strength;                      // one shadow, without gaps
      EXPECT_LT(most, 0.35) << "metres off the line, strength " << strength;  // a pixel is 0.2 to 0.3 m
      RecordProperty("off_line_mm_" + std::to_string(int(strength)), int(1000 * most));
    }
  }
}

// A courtyard of posts, seen from anywhere: what the light does not reach by a ray is in shadow, at both ends
// of the sigmoid's range. Points within a few texels of a shadow's edge may be either.
TEST_P(ShadowMapTest, shadowsAreWhereRaysAreBlocked) {
  NOT_WITH_SANITIZERS();
  NEEDS_FINE_RASTER();
  constexpr int kWidth = 192, kHeight = 144;
  TestScene test;
  const int stone = test.material(TestScene::colored("Stone", {0.6f, 0.6f, 0.6f, 1}));
  test.add(gridMesh({-20, 0, 20}, {40, 0, 0}, {0, 0, -40}), stone);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const glm::vec3 at(-15.0f + 6.0f * float(i), 0, -15.0f + 6.0f * float(j));
      test.add(boxMesh(at - glm::vec3(0.5f, 0, 0.5f), at + glm::vec3(0.5f, 3, 0.5f)), stone);
    }
  const glm::dvec3 toLight = glm::normalize(glm::dvec3(-0.7, 0.8, 0.4));
  test.light(glm::vec3(toLight));
  const Scene scene = test.load();
  const Stand stands[] = {{{18, 3, 18}, {0, 0, 0}},
                          {{-17, 2, -16}, {10, 0, 10}},
                          {{1, 9, 19}, {0, 0, 0}},
                          {{-2, 1.6f, 3}, {-20, 1, -20}}};
  for (const char* strength : {"0", "0.3", "4", "16"})
    for (const Stand& stand : stands) {
      const auto views = viewsFrom(scene, stand, kWidth, kHeight, GetParam());
      const Frame frame =
          draw(scene, quietLook({{"light.shadowWarp", strength}, {"light.terminatorSharpness", "8"}}), views,
               sized(kWidth, kHeight, {"shadow", "position", "id"}));
      for (size_t v = 0; v < viewCount(); ++v) {
        size_t shadowed = 0, lost = 0, lit = 0, ghosts = 0;
        for (int y = 0; y < kHeight; y += 2)
          for (int x = 0; x < kWidth; x += 2) {
            if (texel(aov(frame, "id", v), x, y).x != 1) continue;
            const glm::dvec3 p(texel(aov(frame, "position", v), x, y));
            size_t blocked = 0, rays = 0;
            for (int i = -1; i <= 1; ++i)
              for (int j = -1; j <= 1; ++j, ++rays)
                blocked += castRay({p + glm::dvec3(0.2 * i, 1e-3, 0.2 * j), toLight}, test.triangles(), true)
                               .has_value();
            const double light = texel(aov(frame, "shadow", v), x, y).x;
            if (blocked == rays) ++shadowed, lost += light > 0.5;
            if (blocked == 0) ++lit, ghosts += light < 0.5;
          }
        ASSERT_GT(shadowed, 20u);
        ASSERT_GT(lit, 100u);
        EXPECT_LE(lost, shadowed / 100) << "strength " << strength << ", from " << stand.eye.x;
        EXPECT_LE(ghosts, lit / 100) << "strength " << strength << ", from " << stand.eye.x;
      }
    }
}

// What is told not to cast casts nothing; masked surfaces cast their holes.
TEST_F(ShadowMapTest, castersAndHoles) {
  for (const bool casts : {true, false}) {
    TestScene test;
    Image grid{2, 1, {"R", "G", "B", "A"}, {1, 1, 1, 1, 1, 1, 1, 0}};
    const int texture = test.texture(grid);
    Json screen = TestScene::colored("Screen", {0.5f, 0.5f, 0.5f, 1});
    screen["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", texture}};
    screen["alphaMode"] = "MASK";
    test.add(gridMesh({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}),
             test.material(TestScene::colored("Sand", {0.5f, 0.5f, 0.5f, 1})));
    test.add(gridMesh({-1, 2, 1}, {2, 0, 0}, {0, 0, -2}), test.material(screen));  // left half there
    test.light({0.001f, 1, 0});
    const Scene scene = test.load();
    const auto views = viewsFrom(scene, {{0, 1, 6}, {0, 0, 0}}, 96, 72);
    const Frame frame = draw(scene, quietLook({{"materials.Screen.shadowMap.cast", casts ? "on" : "off"}}),
                             views, sized(96, 72, {"shadow", "id"}));
    const glm::ivec2 left(pixelOf(views[0], {-0.5, 0, 0}, 96, 72)),
        right(pixelOf(views[0], {0.5, 0, 0}, 96, 72));
    ASSERT_EQ(texel(aov(frame, "id"), left.x, left.y).x, 1);
    EXPECT_NEAR(texel(aov(frame, "shadow"), left.x, left.y).x, casts ? 0 : 1, 0.01);
    EXPECT_NEAR(texel(aov(frame, "shadow"), right.x, right.y).x, 1, 0.01);
  }
}

// What lies deeper than all casters, and within their box as the light has it: there is nothing that could
// cast.
TEST_P(ShadowMapTest, whatLiesBeyondAllCastersIsLitBesideTheirShadows) {
  TestScene test;
  const int stone = test.material(TestScene::colored("Stone", {0.6f, 0.6f, 0.6f, 1}));
  test.add(gridMesh({-6, 0, 6}, {12, 0, 0}, {0, 0, -12}),
           test.material(TestScene::colored("Sand", {0.6f, 0.5f, 0.3f, 1})));
  // Two corners of a square; at the others there is light.
  test.add(boxMesh({-1.5f, 2, -1.5f}, {-0.5f, 2.2f, -0.5f}), stone);
  test.add(boxMesh({0.5f, 2, 0.5f}, {1.5f, 2.2f, 1.5f}), stone);
  test.light({0.001f, 1, 0});
  const Scene scene = test.load();
  const auto views = viewsFrom(scene, {{0, 1.5f, 7}, {0, 0, 0}}, 96, 72, GetParam());
  const Frame frame = draw(scene, quietLook({{"materials.Sand.shadowMap.cast", "off"}}), views,
                           sized(96, 72, {"shadow", "id"}));
  for (size_t v = 0; v < viewCount(); ++v)
    for (const double x : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0}) {
        const glm::ivec2 at(pixelOf(views[v], {x, 0, z}, 96, 72));
        ASSERT_EQ(texel(aov(frame, "id", v), at.x, at.y).x, 1);
        EXPECT_NEAR(texel(aov(frame, "shadow", v), at.x, at.y).x, x == z ? 0 : 1, 0.01) << x << ", " << z;
      }
}

// A plane of 600 metres does not take the map from the box that stands on it. (SwiftShader interpolates over
// larger triangles by more than a texel off.)
TEST_P(ShadowMapTest, largeGroundsLeaveTheMapToWhatStandsOnThem) {
  TestScene test;
  test.add(gridMesh({-300, 0, 300}, {600, 0, 0}, {0, 0, -600}),
           test.material(TestScene::colored("Sand", {0.6f, 0.5f, 0.3f, 1})));
  test.add(boxMesh({-0.5f, 1, -0.5f}, {0.5f, 1.4f, 0.5f}),
           test.material(TestScene::colored("Stone", {0.6f, 0.6f, 0.6f, 1})));
  test.light({0.001f, 1, 0});
  const Scene scene = test.load();
  const auto views = viewsFrom(scene, {{0, 1.5f, 5}, {0, 0, 0}}, 96, 72, GetParam());
  const Frame frame = draw(scene, quietLook({}), views, sized(96, 72, {"shadow", "id"}));
  for (size_t v = 0; v < viewCount(); ++v)
    for (const double x : {-1.0, -0.6, -0.4, 0.0, 0.4, 0.6, 1.0}) {
      const glm::ivec2 at(pixelOf(views[v], {x, 0, 0.4}, 96, 72));
      ASSERT_EQ(texel(aov(frame, "id", v), at.x, at.y).x, 1);
      EXPECT_NEAR(texel(aov(frame, "shadow", v), at.x, at.y).x, std::abs(x) > 0.5 ? 1 : 0, 0.01) << x;
    }
}

}  // namespace
}  // namespace scumble::passes
