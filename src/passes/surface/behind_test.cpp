// What lies behind the first surface, where ripple is layered: its light is its own (docs/passes.md: one
// sample, light without the blur).
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

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

// A torus of `around` by `across` vertices, the middle of its tube 0.9 m from its own.
TestMesh ring(uint32_t around, uint32_t across) {
  TestMesh mesh;
  for (uint32_t i = 0; i < around; ++i)
    for (uint32_t k = 0; k < across; ++k) {
      const float a = 2 * glm::pi<float>() * float(i) / float(around),
                  b = 2 * glm::pi<float>() * float(k) / float(across);
      const glm::vec3 out(std::cos(a), 0, std::sin(a)),
          normal = std::cos(b) * out + glm::vec3(0, std::sin(b), 0);
      mesh.positions.push_back(0.9f * out + 0.45f * normal);
      mesh.normals.push_back(normal);
      mesh.uvs.push_back({float(i) / float(around), float(k) / float(across)});
      const auto at = [&](uint32_t x, uint32_t y) { return x % around * across + y % across; };
      for (const uint32_t v :
           {at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i, k), at(i + 1, k + 1), at(i + 1, k)})
        mesh.indices.push_back(v);
    }
  return mesh;
}

// Paper 000, 7.3: an edge that is torn inwards shows what lies behind the form, and never the form's own back
// wall, which double-sided materials have. From within, that wall is what lies behind.
TEST_P(BehindTest, tornEdgesShowNoBackOfTheirOwn) {
  const TestMesh forms[] = {ring(48, 24), sphereMesh({}, 1, 48), boxMesh({-1, -1, -1}, {1, 1, 1})};
  const Look look = quietLook({{"final.ripple", "layered"}, {"warp.amount", "48"}, {"warp.inflation", "30"}});
  for (const TestMesh& form : forms)
    for (const float mirror : {1.0f, -1.0f}) {
      size_t holes[2] = {0, 0};
      for (const bool isDoubleSided : {false, true}) {
        TestScene s;
        Json material = TestScene::colored("Form", {0.7f, 0.3f, 0.2f, 1});
        material["doubleSided"] = isDoubleSided;
        s.add(form, s.material(material), glm::scale(glm::mat4(1.0f), {mirror, 1, 1}));
        s.light({-0.4f, 1, 0.5f});
        const Scene scene = s.load();
        const auto views =
            viewsFrom(scene, {{1.2f, 2.6f, 3.4f}, {0, 0, 0}, 42}, kBehindWidth, kBehindHeight, GetParam());
        RenderOptions options = sized(kBehindWidth, kBehindHeight, {"id"});
        options.transparent = true;
        const Frame frame = draw(scene, look, views, options);
        for (size_t v = 0; v < viewCount(); ++v)
          for (int y = 0; y < kBehindHeight; ++y)
            for (int x = 0; x < kBehindWidth; ++x)
              holes[isDoubleSided] +=
                  texel(aov(frame, "id", v), x, y).x != 0 && texel(aov(frame, "", v), x, y).a < 0.5;
      }
      EXPECT_GT(holes[0], 40 * viewCount());
      EXPECT_NEAR(double(holes[1]), double(holes[0]), 0.02 * double(holes[0]))
          << "form " << &form - forms << ", mirrored " << mirror;
    }
}

TEST_P(BehindTest, tornEdgesShowTheRoomAround) {
  TestScene s;
  Json walls = TestScene::colored("Walls", {0.3f, 0.4f, 0.8f, 1});
  walls["doubleSided"] = true;
  s.add(boxMesh({-4, -4, -4}, {4, 4, 4}), s.material(walls));
  s.add(sphereMesh({}, 1, 48), s.material(TestScene::colored("Ball", {0.8f, 0.3f, 0.2f, 1})));
  s.light({-0.4f, 1, 0.5f});
  const Scene scene = s.load();
  const auto views =
      viewsFrom(scene, {{0, 0.6f, 3.4f}, {0, 0, 0}, 42}, kBehindWidth, kBehindHeight, GetParam());
  RenderOptions options = sized(kBehindWidth, kBehindHeight);
  options.transparent = true;
  const Frame frame = draw(scene,
                           quietLook({{"final.ripple", "layered"},
                                      {"warp.amount", "48"},
                                      {"warp.inflation", "30"},
                                      {"materials.Walls.warp.amount", "0"}}),
                           views, options);
  for (size_t v = 0; v < viewCount(); ++v)
    for (int y = 0; y < kBehindHeight; ++y)
      for (int x = 0; x < kBehindWidth; ++x)
        ASSERT_GT(texel(aov(frame, "", v), x, y).a, 0.99) << x << " " << y;
}

}  // namespace
}  // namespace scumble::passes
