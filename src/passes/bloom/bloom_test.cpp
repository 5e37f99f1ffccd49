// The glow of a lamp leaves its silhouette, as far as it is asked to, whatever lies beside the lamp; and
// highlights are shapes in the lens.
#include <algorithm>
#include <cmath>

#include "tests/support/aov.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"

namespace scumble::passes {
namespace {

using namespace test;

class BloomTest : public BothEyes {
 protected:
  static constexpr int kWidth = 240, kHeight = 180;

  // How much brighter the picture is with bloom, along the row through the lamp's middle, to the right of it.
  std::vector<double> glowBeside(const Scene& scene, const std::vector<View>& views, size_t view, Knobs knobs,
                                 uint32_t samples) const {
    const RenderOptions options = sized(kWidth, kHeight, {}, samples);
    const Frame without = draw(scene, quietLook(knobs), views, options);
    knobs.push_back({"final.bloom", "2"});
    const Frame with = draw(scene, quietLook(knobs), views, options);
    const glm::ivec2 middle(pixelOf(views[view], {0, 0, 0}, kWidth, kHeight));
    std::vector<double> more;
    for (int x = middle.x; x < kWidth; ++x)
      more.push_back(texel(aov(with, "", view), x, middle.y).x -
                     texel(aov(without, "", view), x, middle.y).x);
    return more;
  }
};
INSTANTIATE_BOTH_EYES(BloomTest);

// A small lamp before the sky, before a wall near by or far away, and mirrored, at one and at four samples a
// pixel.
TEST_P(BloomTest, leavesTheSilhouette) {
  for (const float wall : {0.0f, -1.0f, -40.0f})
    for (const uint32_t samples : {1u, 4u}) {
      SCOPED_TRACE("wall at " + std::to_string(wall) + ", samples " + std::to_string(samples));
      TestScene s;
      Json lamp = TestScene::unlit("Lamp", {1, 1, 1, 1});
      lamp["emissiveFactor"] = {1, 1, 1};
      s.add(sphereMesh({0, 0, 0}, 0.08f, 24), s.material(lamp));
      if (wall < 0)
        s.add(gridMesh({-60, -60, wall}, {120, 0, 0}, {0, 120, 0}),
              s.material(TestScene::colored("Wall", {0.02f, 0.02f, 0.02f, 1})));
      const Scene scene = s.load();
      const auto views = viewsFrom(scene, {{0, 0, 3}, {0, 0, 0}, 40}, kWidth, kHeight, GetParam());
      const int radius = int(0.08 / 3 / std::tan(glm::radians(20.0)) * kHeight / 2) + 1;
      for (size_t v = 0; v < viewCount(); ++v)
        for (const double percent : {2.0, 6.0}) {
          const auto more = glowBeside(scene, views, v,
                                       {{"final.bloomReach", std::to_string(percent)},
                                        {"background.horizon", "#101010"},
                                        {"background.zenith", "#101010"}},
                                       samples);
          const double reach = 0.01 * percent * kHeight;
          EXPECT_GT(more[size_t(radius + 0.3 * reach)], 0.04) << percent;
          EXPECT_EQ(more[size_t(radius + 1.5 * reach + 8)], 0) << percent;
        }
    }
}

// A smooth ball's highlight is a shape in the lens: all or nothing, where the light is mirrored; a rough one
// has none.
TEST_P(BloomTest, highlightsAreShapesInTheLens) {
  for (const float roughness : {0.3f, 0.6f, 1.0f}) {
    const double bright = (1 - roughness) * (1 - roughness);
    TestScene s;
    Json ball = TestScene::colored("Ball", {0.5f, 0.5f, 0.5f, 1});
    ball["pbrMetallicRoughness"]["roughnessFactor"] = roughness;
    s.add(sphereMesh({0, 0, 0}, 1, 96), s.material(ball));
    const glm::dvec3 toLight = glm::normalize(glm::dvec3(-0.5, 0.6, 0.8));
    s.light(glm::vec3(toLight));
    const Scene scene = s.load();
    const glm::vec3 eye(0.3f, 0.2f, 4);
    const auto views = viewsFrom(scene, {eye}, kWidth, kHeight, GetParam());
    const Frame on = draw(scene, quietLook({{"surface.highlight", "1"}}), views,
                          sized(kWidth, kHeight, {"shadow", "normal", "position", "id"}));
    const Frame off = draw(scene, quietLook(), views, sized(kWidth, kHeight, {"shadow"}));
    for (size_t v = 0; v < viewCount(); ++v) {
      size_t full = 0, edge = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          if (texel(aov(on, "id", v), x, y).x != 1) continue;
          EXPECT_EQ(texel(aov(off, "shadow", v), x, y).y, 0);
          const glm::dvec3 normal(texel(aov(on, "normal", v), x, y)), p(texel(aov(on, "position", v), x, y));
          const glm::dvec3 toEye = glm::normalize(glm::dvec3(eye) - p);
          if (glm::dot(normal, toEye) < 0.3) continue;  // edges are a pixel wide, which is much there
          const double mirrored = glm::dot(normal, glm::normalize(toLight + toEye));
          const double angle = std::acos(std::min(mirrored, 1.0)),
                       least = std::atan(std::max(0.5f * roughness * roughness, 0.06f));
          const double got = texel(aov(on, "shadow", v), x, y).y;
          // A pixel is up to three degrees wide there.
          if (angle < least - 0.05) {
            EXPECT_NEAR(got, bright, 0.01) << x << ", " << y;
          }
          if (angle > least + 0.05) {
            EXPECT_EQ(got, 0) << x << ", " << y;
          }
          if (bright > 0) full += got > 0.9 * bright, edge += got > 0 && got < 0.9 * bright;
        }
      if (roughness < 1) {
        EXPECT_GT(full, 20u) << roughness;
        EXPECT_LT(edge, 2 * full) << roughness;
      }
    }
  }
}

}  // namespace
}  // namespace scumble::passes
