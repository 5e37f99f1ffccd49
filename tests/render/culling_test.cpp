// What is not drawn because no view sees it: only that.
#include "tests/support/aov.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"

namespace scumble {
namespace {

using namespace test;

constexpr int kCullWidth = 64, kCullHeight = 48;

class Culling : public BothEyes {};
INSTANTIATE_BOTH_EYES(Culling);

// A ball at each border that only one eye has in its picture.
TEST_P(Culling, eachEyeSeesWhatIsItsOwn) {
  for (const float side : {-1.0f, 1.0f}) {
    TestScene s;
    const int m = s.material(TestScene::colored("Grey", {0.5f, 0.5f, 0.5f, 1}));
    s.add(sphereMesh({side * 2.6f, 0, 0}, 0.4f, 12), m);
    const Scene scene = s.load();
    const auto views =
        viewsFrom(scene, {{0, 0, 5}, {0, 0, 0}, 40, 0, 1}, kCullWidth, kCullHeight, GetParam());
    const Frame frame = draw(scene, quietLook(), views, sized(kCullWidth, kCullHeight, {"id"}));
    size_t all = 0;
    for (size_t v = 0; v < viewCount(); ++v) {
      size_t hits = 0, got = 0;
      for (int y = 0; y < kCullHeight; ++y)
        for (int x = 0; x < kCullWidth; ++x) {
          hits += castRay(pixelRay(views[v], x, y, kCullWidth, kCullHeight), s.triangles()).has_value();
          got += texel(aov(frame, "id", v), x, y).x == 1;
        }
      EXPECT_NEAR(double(got), double(hits), 4) << "side " << side << ", view " << v;
      all += hits;
    }
    EXPECT_GE(all, viewCount() > 1 ? 20u : 0u) << "one eye sees it";
  }
}

// A thing six pixels outside of the picture, whose inflated surface reaches twelve pixels far: by the look
// alone, or by less and the vertices' own factor.
TEST_P(Culling, inflatedSurfacesReachIn) {
  for (const auto& [percent, scale] : {std::pair("25", 1.0f), std::pair("6.25", 4.0f)}) {
    TestScene s;
    TestMesh ball = sphereMesh({0, 0, 0}, 0.5f, 24);
    if (scale != 1) ball.warpScales.assign(ball.positions.size(), scale);
    s.add(ball, s.material(TestScene::colored("Grey", {0.5f, 0.5f, 0.5f, 1})));
    const Scene scene = s.load();
    std::vector<View> views(viewCount(), parallelView(1, float(kCullWidth) / kCullHeight));
    const float pixel = 2.0f / kCullHeight, edge = float(kCullWidth) / kCullHeight;
    for (const float side : {-1.0f, 1.0f}) {
      for (View& view : views) view.worldToEye[3][0] = side * (edge + 0.5f + 6 * pixel);
      const Frame frame =
          draw(scene, quietLook({{"warp.inflationUnit", "percent"}, {"warp.inflation", percent}}), views,
               sized(kCullWidth, kCullHeight, {"warp", "id"}));
      for (size_t v = 0; v < viewCount(); ++v) {
        size_t covered = 0;
        for (int y = 0; y < kCullHeight; ++y)
          for (int x = 0; x < kCullWidth; ++x) {
            EXPECT_EQ(texel(aov(frame, "id", v), x, y).x, 0);
            covered += texel(aov(frame, "warp", v), x, y).w > 0;
          }
        EXPECT_GT(covered, 20u) << "side " << side << ", view " << v << ", factor " << scale;
      }
    }
  }
}

// A sheet above a floor casts its shadow whichever way it faces, and a body whose near side is open, too.
TEST_P(Culling, shadowsAreOfBothSides) {
  const auto drawnWith = [&](bool facesDown, bool doubleSided, float mirror) {
    TestScene s;
    s.add(gridMesh({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}, 1),
          s.material(TestScene::colored("Floor", {0.5f, 0.5f, 0.5f, 1})));
    Json sheet = TestScene::colored("Sheet", {0.7f, 0.2f, 0.2f, 1});
    sheet["doubleSided"] = doubleSided;
    const glm::vec3 along = facesDown ? glm::vec3(0, 0, 1) : glm::vec3(0, 0, -1);
    glm::mat4 matrix(1.0f);
    matrix[0][0] = mirror;
    s.add(gridMesh({-0.5f, 1.5f, facesDown ? -0.5f : 0.5f}, {1, 0, 0}, along, 1), s.material(sheet), matrix);
    s.light({0.5f, 1, 0.3f});
    const Scene scene = s.load();
    const auto views = viewsFrom(scene, {{0, 0.9f, 6}, {0, 0, 0}}, kCullWidth, kCullHeight, GetParam());
    return draw(scene, quietLook(), views, sized(kCullWidth, kCullHeight, {"shadow", "id"}));
  };
  const Frame expected = drawnWith(false, true, 1);
  for (const bool facesDown : {false, true})
    for (const float mirror : {1.0f, -1.0f}) {
      const Frame frame = drawnWith(facesDown, false, mirror);
      for (size_t v = 0; v < viewCount(); ++v) {
        int dark = 0, others = 0;
        for (int y = 0; y < kCullHeight; ++y)
          for (int x = 0; x < kCullWidth; ++x) {
            if (texel(aov(frame, "id", v), x, y).x != 1 || texel(aov(expected, "id", v), x, y).x != 1)
              continue;
            const double light = texel(aov(frame, "shadow", v), x, y).x;
            dark += light < 0.3;
            others += std::abs(light - texel(aov(expected, "shadow", v), x, y).x) > 0.3;
          }
        EXPECT_GE(dark, 8) << "faces down: " << facesDown << ", mirror " << mirror;
        EXPECT_LE(others, 2) << "faces down: " << facesDown << ", mirror " << mirror;
      }
    }
}

}  // namespace
}  // namespace scumble
