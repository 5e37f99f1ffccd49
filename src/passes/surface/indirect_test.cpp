// Light between surfaces in pictures: shadow beside what stands close by is deeper, in steps, and takes its
// hue; what is far from everything, and light, stay as they are.
#include <cmath>

#include "tests/support/aov.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"

namespace scumble::passes {
namespace {

using namespace test;

class IndirectTest : public BothEyes {
 protected:
  static constexpr int kSide = 120;

  // A wall that stands on a floor; the wall may be white with vertex colours, dark at its foot.
  static Scene wallOnFloor(bool isColored = false) {
    TestScene s;
    const int floor = s.material(TestScene::colored("Floor", {0.6f, 0.6f, 0.6f, 1})),
              wall = s.material(TestScene::colored("Wall", {0.8f, 0.08f, 0.05f, 1}));
    s.add(gridMesh({-2, 0, -1}, {0, 0, 4}, {4, 0, 0}, 48), floor);
    TestMesh standing = gridMesh({-2, 0, -1}, {4, 0, 0}, {0, 2, 0}, 48);
    if (isColored)
      for (const glm::vec3& position : standing.positions) {
        const float light = glm::clamp(0.1f + position.y, 0.0f, 1.0f);
        standing.colors.push_back({light, light, light, 1});
      }
    s.add(standing, wall);
    return s.load();
  }
  Frame drawWith(const Scene& scene, const Knobs& knobs) {
    return draw(scene, quietLook(knobs), views(scene), sized(kSide, kSide, {"lit", "shadowed", "id"}));
  }
  static std::vector<View> views(const Scene& scene) {
    return viewsFrom(scene, {{0, 3, 6}, {0, 0.6f, 0}, 34}, kSide, kSide, GetParam());
  }
  static glm::dvec3 rootAt(const Frame& frame, const char* name, size_t view, const glm::dvec2& at) {
    return glm::sqrt(glm::dvec3(texel(aov(frame, name, view), int(at.x), int(at.y))));
  }
};
INSTANTIATE_BOTH_EYES(IndirectTest);

TEST_P(IndirectTest, shadowIsDeeperBesideOthersInSteps) {
  const Scene scene = wallOnFloor();
  const auto eyes = views(scene);
  const Frame plain = drawWith(scene, {}),
              deep = drawWith(scene, {{"surface.occlusion", "1"}, {"indirect.reach", "0.4"}});
  for (size_t v = 0; v < viewCount(); ++v) {
    const auto depthAt = [&](const glm::dvec3& place) {
      const glm::dvec2 at = pixelOf(eyes[v], place, kSide, kSide);
      return rootAt(deep, "shadowed", v, at).y / rootAt(plain, "shadowed", v, at).y;
    };
    for (const double x : {-0.7, 0.0, 0.7}) {
      EXPECT_LT(depthAt({x, 0, -0.95}), 0.85) << x;
      EXPECT_NEAR(depthAt({x, 0, 1.5}), 1, 0.01) << x;
      EXPECT_LT(depthAt({x, 0.08, -1}), 0.85) << x;
      EXPECT_NEAR(depthAt({x, 1.6, -1}), 1, 0.01) << x;
    }
    int stepped = 0, all = 0;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        if (texel(aov(plain, "id", v), x, y).x == 0) continue;
        const glm::dvec2 at(x + 0.5, y + 0.5);
        const double steps =
            (1 - rootAt(deep, "shadowed", v, at).y / rootAt(plain, "shadowed", v, at).y) / 0.2;
        ++all, stepped += std::abs(steps - std::round(steps)) < 0.06;
        EXPECT_EQ(texel(aov(deep, "lit", v), x, y), texel(aov(plain, "lit", v), x, y));
      }
    EXPECT_GT(stepped, 0.9 * all);
  }
}

TEST_P(IndirectTest, shadowTakesTheHueOfWhatIsCloseBy) {
  const Scene scene = wallOnFloor();
  const auto eyes = views(scene);
  const Frame plain = drawWith(scene, {}),
              tinted = drawWith(scene, {{"surface.bounce", "1"}, {"indirect.reach", "0.4"}});
  for (size_t v = 0; v < viewCount(); ++v) {
    const auto warmth = [&](const Frame& frame, const glm::dvec3& place) {
      const glm::dvec3 root = rootAt(frame, "shadowed", v, pixelOf(eyes[v], place, kSide, kSide));
      return root.r / root.b;
    };
    EXPECT_GT(warmth(tinted, {0, 0, -0.95}), 1.15 * warmth(plain, {0, 0, -0.95}));
    EXPECT_NEAR(warmth(tinted, {0, 0, 1.5}), warmth(plain, {0, 0, 1.5}), 0.01);
    // As light as it was.
    const glm::dvec2 at = pixelOf(eyes[v], {0, 0, -0.95}, kSide, kSide);
    const auto value = [&](const Frame& frame) {
      const glm::dvec3 root = rootAt(frame, "shadowed", v, at);
      return glm::dot(root * root, glm::dvec3(0.2126, 0.7152, 0.0722));
    };
    EXPECT_NEAR(value(tinted), value(plain), 0.2 * value(plain));
  }
}

// Light that somebody has baked into vertex colours colours nothing, and is shadow's.
TEST_P(IndirectTest, vertexColorsMayBeLight) {
  const Scene scene = wallOnFloor(true), white = wallOnFloor();
  const auto eyes = views(scene);
  const Knobs some{{"indirect.source", "colors"}, {"surface.occlusion", "1"}};
  const Frame plain = drawWith(white, {}), baked = drawWith(scene, some), colored = drawWith(scene, {});
  for (size_t v = 0; v < viewCount(); ++v) {
    const auto at = [&](double y) { return pixelOf(eyes[v], {0, y, -1}, kSide, kSide); };
    for (const double y : {0.1, 1.5}) {
      const glm::dvec3 got = rootAt(baked, "lit", v, at(y)), own = rootAt(plain, "lit", v, at(y));
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], own[c], 0.04) << y;
    }
    EXPECT_LT(rootAt(colored, "lit", v, at(0.1)).r, 0.9 * rootAt(plain, "lit", v, at(0.1)).r);
    EXPECT_LT(rootAt(baked, "shadowed", v, at(0.1)).r, 0.85 * rootAt(plain, "shadowed", v, at(0.1)).r);
    EXPECT_NEAR(rootAt(baked, "shadowed", v, at(1.5)).r, rootAt(plain, "shadowed", v, at(1.5)).r, 0.02);
  }
}

}  // namespace
}  // namespace scumble::passes
