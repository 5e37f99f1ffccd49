// What lies behind the first surface, where ripple is layered: its light is its own (docs/passes.md: one
// sample, light without the blur).
#include <cmath>

#include "passes/surface/surface_knobs.h"
#include "tests/support/aov.h"
#include "tests/support/palette_reference.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"

namespace scumble::passes {
namespace {

using namespace test;

constexpr int kBehindWidth = 160, kBehindHeight = 120;

class BehindTest : public BothEyes {
 protected:
  // A wall whose normals turn from the left to the right by 70 degrees each way, blue in shadow and yellow in
  // light; over its upper part lies the shadow of a bar. Before it a ball, or none, that casts no shadow.
  static Scene wallBehindBall(bool withBall) {
    TestScene s;
    Json wall = TestScene::colored("Wall", {0.8f, 0.7f, 0.05f, 1});
    wall["extras"]["scumble_shadowed"] = "#2030C0";
    TestMesh mesh = gridMesh({-3, -3, -1.5f}, {6, 0, 0}, {0, 6, 0}, 48);
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
      const float turn = glm::radians(70.0f) * mesh.positions[i].x / 3;
      mesh.normals[i] = {std::sin(turn), 0, std::cos(turn)};
    }
    s.add(mesh, s.material(wall));
    s.add(boxMesh({-6, 0.25f, 0.5f}, {-1.8f, 0.75f, 0.6f}),
          s.material(TestScene::colored("Bar", {0.5f, 0.5f, 0.5f, 1})));
    if (withBall)
      s.add(sphereMesh({0.7f, 0, 0}, 1, 48), s.material(TestScene::unlit("Ball", {0.9f, 0.9f, 0.9f, 1})));
    s.light({-1, 0, 0.55f});
    return s.load();
  }
};
INSTANTIATE_BOTH_EYES(BehindTest);

TEST_P(BehindTest, hasItsOwnLight) {
  const Scene both = wallBehindBall(true), alone = wallBehindBall(false);
  const auto views =
      viewsFrom(both, {{0.9f, 0.3f, 4}, {0.7f, 0, 0}, 40}, kBehindWidth, kBehindHeight, GetParam());
  const Look look = quietLook({{"final.ripple", "layered"},
                               {"light.terminatorSharpness", "0.5"},
                               {"warp.amount", "64"},
                               {"warp.inflation", "40"},
                               {"palette.skyTint", "0"},
                               {"materials.Ball.shadowMap.cast", "off"},
                               {"materials.Wall.warp.amount", "0"}});
  const Frame with = draw(both, look, views, sized(kBehindWidth, kBehindHeight, {"id", "cryptomatte"})),
              without = draw(alone, look, views, sized(kBehindWidth, kBehindHeight, {"shadow", "id"}));
  const glm::dvec3 lit(0.8, 0.7, 0.05), shadowed = referenceColor(0x2030C0);
  size_t light = 0, dark = 0, between = 0, cast = 0;
  for (size_t v = 0; v < viewCount(); ++v) {
    Difference colors(0.02);
    for (int y = 0; y < kBehindHeight; ++y)
      for (int x = 0; x < kBehindWidth; ++x) {
        if (texel(aov(with, "id", v), x, y).x != 3 || texel(aov(without, "id", v), x, y).x != 1) continue;
        const glm::dvec4 got = texel(aov(with, "", v), x, y);
        // A pixel is the mean of four places: all of them show the wall.
        const Image& matte = aov(with, "cryptomatte", v);
        if (matte.at(uint32_t(x), uint32_t(y), 0) != 1 || matte.at(uint32_t(x), uint32_t(y), 1) < 0.999f)
          continue;
        const double own = texel(aov(without, "shadow", v), x, y).x,
                     hard = std::clamp(0.5 + 8 * (own - 0.5), 0.0, 1.0);
        // Edges of the bar's shadow are filtered, and triangles of the wall end.
        bool isEven = true;
        for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
          isEven &= std::abs(texel(aov(without, "shadow", v), x + dx, y + dy).x - own) < 0.02;
        if (!isEven) continue;
        const glm::dvec3 expected = glm::mix(shadowed, lit, hard);
        for (int c = 0; c < 3; ++c) colors.add(got[c], expected[c]);
        light += hard == 1, dark += hard == 0, between += hard > 0.05 && hard < 0.95;
        cast += own < 0.2;
      }
    // Eight times light in 8 bits, and square roots of colours in as many; edges of the bar's shadow are
    // filtered.
    EXPECT_LT(colors.beyondPart(), 0.08) << colors.text();
    EXPECT_LT(colors.mean(), 8e-3) << colors.text();
  }
  EXPECT_GT(light, 20 * viewCount());
  EXPECT_GT(dark, 25 * viewCount());
  EXPECT_GT(between, 8 * viewCount());
  EXPECT_GT(cast, 10 * viewCount());
}

}  // namespace
}  // namespace scumble::passes
