// The yardstick's picture: base colours as they are, nearest surfaces by rays, holes, and blending over what
// is behind.
#include <cmath>

#include "scumble/yardstick.h"
#include "tests/support/aov.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"

namespace scumble::passes {
namespace {

using namespace test;

class PlainTest : public BothEyes {
 protected:
  static constexpr int kWidth = 64, kHeight = 48;

  static Frame drawPlain(const Scene& scene, const std::vector<View>& views, int width = kWidth,
                         int height = kHeight) {
    Result<Frame> frame =
        renderYardstick(renderer(), scene, quietLook(), 0, views, sized(uint32_t(width), uint32_t(height)));
    if (!frame) throw std::runtime_error(frame.error().message());
    return std::move(frame).value();
  }
  // sRGB in 8 bits: half a step of its code is at most 0.45 percent of a linear 1.
  static constexpr double kStep = 5e-3;
};
INSTANTIATE_BOTH_EYES(PlainTest);

TEST_P(PlainTest, baseColorsOfWhatIsNearest) {
  TestScene s;
  const glm::dvec4 factors[] = {{0.8, 0.4, 0.2, 1}, {0.3, 0.6, 0.9, 1}};
  for (int i = 0; i < 2; ++i) {
    TestMesh mesh =
        i == 0 ? sphereMesh({0.4f, 0.3f, 0.5f}, 0.7f, 24) : boxMesh({-1, -0.8f, -0.5f}, {0.6f, 0.4f, 0.4f});
    // One colour a vertex, all the same: it multiplies the factor.
    mesh.colors.assign(mesh.positions.size(), {0.5f, 1, 0.25f, 1});
    s.add(mesh, s.material(TestScene::colored("Thing", glm::vec4(factors[i]))));
  }
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0.8f, 0.9f, 4}}, kWidth, kHeight, GetParam());
  const Frame frame = drawPlain(scene, views);
  ASSERT_EQ(frame.layers.front().views.size(), viewCount());
  for (size_t v = 0; v < viewCount(); ++v) {
    size_t hits = 0, wrong = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const auto hit = castRay(pixelRay(views[v], x, y, kWidth, kHeight), s.triangles());
        // Vertex colours have 8 bits: 128 and 64 of 255.
        const glm::dvec4 expected =
            hit ? factors[hit->id - 1] * glm::dvec4(128 / 255.0, 1, 64 / 255.0, 1) : glm::dvec4(0.0);
        const glm::dvec4 got = texel(aov(frame, "", v), x, y);
        hits += hit.has_value();
        bool fits = true;
        for (int c = 0; c < 4; ++c) fits &= std::abs(got[c] - expected[c]) <= kStep;
        wrong += !fits;
      }
    EXPECT_GT(hits, 500u);
    EXPECT_LE(wrong, hits / 100) << "view " << v;  // at edges
  }
}

// Left half whole, right half 0.4 of alpha; over a wall behind them.
TEST_P(PlainTest, alphaByItsMode) {
  const double alpha = 102 / 255.0;
  for (const char* mode : {"OPAQUE", "MASK", "BLEND"}) {
    TestScene s;
    const Image image{2, 1, {"R", "G", "B", "A"}, {1, 1, 1, 1, 1, 1, 1, float(alpha)}};
    Json json = TestScene::colored("Pane", {0.1f, 0.2f, 0.9f, 1});
    json["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", s.texture(image)}};
    json["alphaMode"] = mode;
    s.add(gridMesh({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), s.material(json));
    s.add(gridMesh({-2, -2, -1}, {4, 0, 0}, {0, 4, 0}),
          s.material(TestScene::colored("Wall", {0.7f, 0.5f, 0.1f, 1})));
    const Scene scene = s.load();
    const auto views = viewsFrom(scene, {{0, 0, 4}}, kWidth, kHeight, GetParam());
    const Frame frame = drawPlain(scene, views);
    const glm::dvec3 pane(0.1, 0.2, 0.9), wall(0.7, 0.5, 0.1);
    for (size_t v = 0; v < viewCount(); ++v) {
      const glm::ivec2 left(pixelOf(views[v], {-0.5, 0, 0}, kWidth, kHeight)),
          right(pixelOf(views[v], {0.5, 0, 0}, kWidth, kHeight));
      const glm::dvec3 expected = mode[0] == 'O' ? pane : mode[0] == 'M' ? wall : glm::mix(wall, pane, alpha);
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(texel(aov(frame, "", v), left.x, left.y)[c], pane[c], kStep) << mode;
        EXPECT_NEAR(texel(aov(frame, "", v), right.x, right.y)[c], expected[c], kStep) << mode;
      }
      EXPECT_EQ(texel(aov(frame, "", v), right.x, right.y).w, 1) << mode;
    }
  }
}

// Where nothing is behind, coverage is the alpha, and colours come back straight.
TEST_F(PlainTest, coverageOfAPaneAlone) {
  TestScene s;
  Json json = TestScene::colored("Pane", {0.5f, 0.2f, 0.8f, 0.5f});
  json["alphaMode"] = "BLEND";
  s.add(gridMesh({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), s.material(json));
  const Frame frame = drawPlain(s.load(), {parallelView(2, 1)}, 8, 8);
  const glm::dvec4 got = texel(aov(frame, ""), 4, 4);
  EXPECT_NEAR(got.w, 0.5, 0.5 / 255 + 1e-6);
  // Premultiplied, in steps of its code: twice as coarse.
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], (glm::dvec3(0.5, 0.2, 0.8))[c], 2 * kStep);
  EXPECT_EQ(texel(aov(frame, ""), 0, 0), glm::dvec4(0.0));
}

}  // namespace
}  // namespace scumble::passes
