// The picture against the same in double precision, from the `color`, `warp`, `depth` and `blur` AOVs; and
// FORMULAS 10.
#include "passes/final_color/final_color.h"

#include <algorithm>
#include <cmath>

#include "tests/support/aov.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"

namespace scumble::passes {
namespace {

using namespace test;

class FinalColorTest : public BothEyes {
 protected:
  static constexpr int kWidth = 160, kHeight = 120;

  // Where a pixel is fetched from, as the shader's floats have it.
  static glm::vec2 displaced(const Frame& frame, size_t view, int x, int y) {
    const glm::dvec4 warp = texel(aov(frame, "warp", view), x, y);
    const glm::vec2 size(kWidth, kHeight);
    return glm::clamp(glm::vec2(x, y) + 0.5f + glm::vec2(warp), glm::vec2(0.5f), size - 0.5f);
  }
};
INSTANTIATE_BOTH_EYES(FinalColorTest);

TEST_P(FinalColorTest, equalsItsReference) {
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
  const glm::dvec3 tint(glm::vec3(FinalColorParams().bloomTint));
  for (const bool aware : {false, true})
    for (const bool transparent : {false, true}) {
      const Look look = quietLook({{"final.ripple", aware ? "depth-aware" : "paper"},
                                   {"final.bloom", "2.5"},
                                   {"blur.radius", "80"},
                                   {"warp.amount", "40"},
                                   {"warp.inflation", "30"}});
      RenderOptions options = sized(kWidth, kHeight, {"color", "warp", "depth", "blur"});
      options.transparent = transparent;
      const Frame frame = draw(scene, look, views, options);
      for (size_t v = 0; v < viewCount(); ++v) {
        const Texels blur = quarterTexels(aov(frame, "blur", v));
        Difference difference(1);
        size_t undecided = 0, kept = 0, moved = 0, wrong = 0;
        for (int y = 0; y < kHeight; ++y)
          for (int x = 0; x < kWidth; ++x) {
            const double surface = 1.01 * texel(aov(frame, "warp", v), x, y).w;
            glm::vec2 at = displaced(frame, v, x, y);
            if (aware) {
              const Image& depth = aov(frame, "depth", v);
              const double nearest = std::min(texel(depth, x, y).x, texel(depth, int(at.x), int(at.y)).x);
              // Float depths that are this close compare either way.
              if (std::abs(nearest - surface) < 1e-3 * surface) {
                ++undecided;
                continue;
              }
              if (nearest > surface) at = glm::vec2(x, y) + 0.5f, ++kept;
            }
            moved += at != glm::vec2(x, y) + 0.5f;
            // Bilinear, premultiplied; `spread` is how far the four texels differ.
            const auto bilinear = [&](const auto& fetch, const glm::dvec2& where, glm::dvec4& spread) {
              const glm::dvec2 corner = glm::floor(where), f = where - corner;
              const int i = int(corner.x), j = int(corner.y);
              const glm::dvec4 a = fetch(i, j), b = fetch(i + 1, j), c = fetch(i, j + 1),
                               d = fetch(i + 1, j + 1);
              spread = glm::max(glm::max(a, b), glm::max(c, d)) - glm::min(glm::min(a, b), glm::min(c, d));
              return glm::mix(glm::mix(a, b, f.x), glm::mix(c, d, f.x), f.y);
            };
            glm::dvec4 spread, blurSpread;
            const Image& color = aov(frame, "color", v);
            glm::dvec4 e =
                bilinear([&](int i, int j) { return texel(color, i, j); }, glm::dvec2(at) - 0.5, spread);
            const glm::dvec4 glow = bilinear(
                [&](int i, int j) {
                  const glm::dvec4 b = blur.clamped(i, j);
                  return glm::dvec4(b.y * b.w, 0, 0, 0);
                },
                (glm::dvec2(x, y) + 0.5) / 4.0 - 0.5, blurSpread);
            e += glm::dvec4(2.5 * tint * glow.x * e.w, 0);
            glm::dvec4 g = texel(aov(frame, "", v), x, y);
            g *= glm::dvec4(g.w, g.w, g.w, 1);
            // Vulkan asks for filter weights in steps of 1/256; half floats round by 2^-11 of up to 3.5.
            bool fits = true;
            for (int c = 0; c < 4; ++c) {
              fits &= std::abs(g[c] - e[c]) <= 2e-3 + (2 * spread[c] + 2.5 * blurSpread.x) / 256;
              difference.add(g[c], e[c]);
            }
            wrong += !fits;
          }
        EXPECT_EQ(wrong, 0u) << difference.text() << (aware ? ", depth-aware" : ", paper");
        EXPECT_LT(difference.mean(), 5e-4);
        EXPECT_LT(undecided, size_t(kWidth * kHeight / 30));
        EXPECT_GT(moved, 2000u);
        EXPECT_GE(kept, aware ? 100u : 0u);
      }
    }
}

// FORMULAS 10: what lies behind an object stays where it is, outside the object's displaced silhouette.
TEST_P(FinalColorTest, rippleKeepsOffTheBackground) {
  // A still checkerboard that is not torn itself, and a ball before it that is.
  const auto makeScene = [](bool withBall) {
    TestScene s;
    s.json()["extensionsUsed"].push_back("KHR_materials_unlit");
    Json board = TestScene::colored("Board", {1, 1, 1, 1}),
         ball = TestScene::colored("Ball", {0.8f, 0.1f, 0.1f, 1});
    board["extensions"]["KHR_materials_unlit"] = ball["extensions"]["KHR_materials_unlit"] = Json::object();
    TestMesh mesh;
    for (int y = -20; y < 20; ++y)
      for (int x = -20; x < 20; ++x) {
        const TestMesh cell =
            gridMesh({0.25f * float(x), 0.25f * float(y), -2}, {0.25f, 0, 0}, {0, 0.25f, 0});
        const uint32_t first = uint32_t(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), cell.positions.begin(), cell.positions.end());
        mesh.normals.insert(mesh.normals.end(), cell.normals.begin(), cell.normals.end());
        mesh.uvs.insert(mesh.uvs.end(), cell.uvs.begin(), cell.uvs.end());
        for (const uint32_t i : cell.indices) mesh.indices.push_back(first + i);
        mesh.colors.insert(mesh.colors.end(), 4,
                           (x + y) & 1 ? glm::vec4(0.9f, 0.9f, 0.9f, 1) : glm::vec4(0.05f, 0.05f, 0.05f, 1));
      }
    s.add(mesh, s.material(board));
    if (withBall) s.add(sphereMesh({0, 0, 0}, 1, 32), s.material(ball));
    return s.load();
  };
  const Scene board = makeScene(false), both = makeScene(true);
  const auto views = viewsFrom(both, {{0.2f, 0.3f, 4}, {0, 0, 0}, 50}, kWidth, kHeight, GetParam());
  size_t changed[2] = {};
  for (const bool aware : {false, true}) {
    const Look look = quietLook({{"final.ripple", aware ? "depth-aware" : "paper"},
                                 {"warp.amount", "40"},
                                 {"warp.inflation", "50"},
                                 {"materials.Board.warp.amount", "0"}});
    const RenderOptions options = sized(kWidth, kHeight, {"id", "warp"});
    const Frame with = draw(both, look, views, options), without = draw(board, look, views, options);
    for (size_t v = 0; v < viewCount(); ++v) {
      size_t outside = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const Image& id = aov(with, "id", v);
          if (texel(id, x, y).x != 1) continue;
          // Outside the displaced silhouette: what the pixel fetches is board on all sides.
          const glm::vec2 at = displaced(with, v, x, y) - 0.5f;
          bool onBoard = true;
          for (int i = 0; i < 4; ++i)
            onBoard &= texel(id, int(std::floor(at.x)) + (i & 1), int(std::floor(at.y)) + (i >> 1)).x == 1;
          if (!onBoard) continue;
          ++outside;
          for (int c = 0; c < 3; ++c)
            if (std::abs(texel(aov(with, "", v), x, y)[c] - texel(aov(without, "", v), x, y)[c]) > 2e-3) {
              ++changed[aware];
              break;
            }
        }
      EXPECT_GT(outside, 5000u);
    }
  }
  EXPECT_GT(changed[0], 50u) << "the paper's ripple";
  EXPECT_EQ(changed[1], 0u) << "depth-aware";
}

}  // namespace
}  // namespace scumble::passes
