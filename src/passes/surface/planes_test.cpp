// Planes of one colour in the light (docs/palette.md).
#include <cmath>

#include "stage/palette.h"
#include "tests/support/aov.h"
#include "tests/support/palette_reference.h"
#include "tests/support/render_test.h"

namespace scumble::passes {
namespace {

using namespace test;

class PlanesTest : public BothEyes {
 protected:
  static constexpr int kWidth = 96, kHeight = 72;
  static inline const glm::dvec3 kColor{0.45, 0.42, 0.4};
  static inline const glm::dvec3 kToLight = glm::normalize(glm::dvec3(-0.6, 0.3, 0.74));

  // A ball of one colour, and behind the viewer a sheet, which is part of the scene's colours.
  static Scene ballAnd(const glm::vec3& sheet, bool varied) {
    TestScene s;
    TestMesh ball = sphereMesh({0, 0, 0}, 1, 64);
    if (varied) ball.colors.assign(ball.positions.size(), glm::vec4(glm::vec3(kColor), 1));
    s.add(ball,
          s.material(TestScene::colored("Ball", varied ? glm::vec4(1) : glm::vec4(glm::vec3(kColor), 1))));
    s.add(gridMesh({-2, -2, 9}, {4, 0, 0}, {0, 4, 0}), s.material(TestScene::colored("Sheet", {sheet, 1})));
    s.light(glm::vec3(kToLight));
    return s.load();
  }

  // Against those that face the light, by the knob's definition.
  static glm::dvec3 tintOf(const glm::dvec3& normal, double planes) {
    const glm::dvec3 sky = 1.0 + planes * glm::dvec3(0.03, 0.07, 0.13),
                     turned = 1.0 - planes * glm::dvec3(0.13, 0.18, 0.24);
    const double faces = smoothstep(0.15, 0.6, glm::dot(normal, kToLight)),
                 up = smoothstep(0.6, 0.95, normal.y);
    const glm::dvec3 root = glm::mix(glm::sqrt(turned), glm::dvec3(1), faces);
    return glm::mix(root, glm::sqrt(sky), up);
  }

  // How far the ball's roots in the light are off.
  void expectPlanes(const Scene& scene, double knob, double planes, bool varied) {
    const Look look = quietLook({{"palette.planes", std::to_string(knob)}});
    const auto views = viewsFrom(scene, {{-0.5f, 0.8f, 6}, {0, 0, 0}, 22}, kWidth, kHeight, GetParam());
    const Frame frame = draw(scene, look, views, sized(kWidth, kHeight, {"lit", "normal", "id"}));
    const FitReference fit([](const glm::dvec3& c) { return PaletteReference().lit(c); });
    const glm::dvec3 own = glm::sqrt(varied ? fit(kColor) : PaletteReference().lit(kColor));
    for (size_t v = 0; v < viewCount(); ++v) {
      Difference roots((varied ? 2.5 : 1.5) / 255);
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          if (texel(aov(frame, "id", v), x, y).x != 1) continue;
          const glm::dvec3 normal(texel(aov(frame, "normal", v), x, y));
          const glm::dvec3 got = glm::sqrt(glm::dvec3(texel(aov(frame, "lit", v), x, y)));
          const glm::dvec3 expected = glm::min(own * tintOf(normal, planes), glm::dvec3(1));
          for (int c = 0; c < 3; ++c) roots.add(got[c], expected[c]);
        }
      EXPECT_LT(roots.beyondPart(), 0.01) << roots.text();
    }
  }
};
INSTANTIATE_BOTH_EYES(PlanesTest);

TEST_P(PlanesTest, oneColourHasThreeValues) {
  for (const bool varied : {false, true}) {
    const Scene scene = ballAnd(glm::vec3(kColor), varied);
    expectPlanes(scene, 1, 1, varied);
    expectPlanes(scene, 2, 2, varied);
    expectPlanes(scene, 0, 0, varied);
  }
}

// A scene of many colours stays as it is; between the two there is some of it.
TEST_P(PlanesTest, manyColoursHaveNone) {
  expectPlanes(ballAnd({0.9f, 0.05f, 0.02f}, false), 1, 0, false);
}

TEST(PlaneTints, fadeWithVariety) {
  stage::SceneColors colors;
  float before = 2;
  for (float variety = 0; variety < 0.3f; variety += 0.02f) {
    colors.variety = variety;
    const stage::PlaneTints tints = stage::planeTints(1, colors);
    EXPECT_LE(tints.sky.b, before);
    before = tints.sky.b;
    // Cooler above, warmer where it turns away.
    EXPECT_GE(tints.sky.b, tints.sky.r);
    EXPECT_LE(tints.turned.b, tints.turned.r);
  }
  EXPECT_EQ(before, 1);
}

}  // namespace
}  // namespace scumble::passes
