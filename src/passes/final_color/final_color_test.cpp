// The picture against the same in double precision, from the `color`, `warp`, `depth` and `blur` AOVs; and
// FORMULAS 10.
#include <algorithm>
#include <cmath>

#include "passes/final_color/final_color_knobs.h"
#include "tests/support/aov.h"
#include "tests/support/displaced.h"
#include "tests/support/glow_reference.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"

namespace scumble::passes {
namespace {

using namespace test;

class FinalColorTest : public BothEyes {
 protected:
  static constexpr int kWidth = 160, kHeight = 120;
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
                                   {"warp.amount", "40"},
                                   {"warp.inflation", "30"}});
      RenderOptions options = sized(kWidth, kHeight, {"color", "warp", "depth", "shadow"});
      options.transparent = transparent;
      const Frame frame = draw(scene, look, views, options);
      for (size_t v = 0; v < viewCount(); ++v) {
        const Texels glows = glowReference(aov(frame, "shadow", v), 4);
        Difference difference(1);
        size_t undecided = 0, kept = 0, moved = 0, wrong = 0;
        for (int y = 0; y < kHeight; ++y)
          for (int x = 0; x < kWidth; ++x) {
            const double surface = texel(aov(frame, "warp", v), x, y).w;
            std::array<glm::dvec2, 4> places = displacedPlaces(aov(frame, "warp", v), x, y);
            const std::array<glm::dvec2, 4> vectors = partVectors(aov(frame, "warp", v), x, y);
            const glm::dvec2 middle = glm::dvec2(x, y) + 0.5;
            bool isUndecided = false;
            for (size_t i = 0; i < 4 && aware && surface > 0; ++i) {
              glm::dvec2& at = places[i];
              // By inverse distances, which planes have linear on the screen.
              const auto inverse = [](const Image& image, int column, int row, int channel) {
                return 1 / texel(image, column, row)[channel];
              };
              const Image &depth = aov(frame, "depth", v), &inflated = aov(frame, "warp", v);
              const double own = inverse(depth, x, y, 0);
              const auto gentler = [&](int dx, int dy) {
                const double here = 1 / surface;
                return std::min(std::abs(here - inverse(inflated, x - dx, y - dy, 3)),
                                std::abs(here - inverse(inflated, x + dx, y + dy, 3)));
              };
              const double slope = gentler(1, 0) + gentler(0, 1),
                           fall = std::min(2 * slope * 30 * kHeight / 1080.0,
                                           1 / surface - 1 / (1.15 * surface)),
                           rise = slope * (glm::length(vectors[i]) + 1.5);
              const double beyond = 1 / (1.01 * surface), before = 1 / (0.97 * surface) + rise;
              // Float depths that are this close compare either way.
              const auto isClose = [](double a, double b) { return std::abs(a - b) < 4e-3 * (a + b); };
              isUndecided |= isClose(own + fall, beyond);
              // So are places beside the border of two texels.
              int keeping = 0;
              for (int beside = 0; beside < 4; ++beside) {
                // The nearest of the texels that are mixed.
                const glm::ivec2 corner =
                    glm::floor(at - 0.5 + 0.02 * glm::dvec2((beside & 1) * 2 - 1, (beside >> 1) * 2 - 1));
                double there = 0;
                for (int t = 0; t < 4; ++t)
                  there = std::max(there, inverse(depth, corner.x + (t & 1), corner.y + (t >> 1), 0));
                isUndecided |= isClose(there + fall, beyond) || isClose(there, before);
                keeping += (std::max(own, there) + fall < beyond) || there > before;
              }
              isUndecided |= keeping % 4 != 0;
              if (keeping > 0) at = middle, ++kept;
            }
            undecided += isUndecided;
            if (isUndecided) continue;
            moved += places[0] != middle;
            // Bilinear, premultiplied; `spread` is how far the four texels differ.
            const auto bilinear = [&](const auto& fetch, const glm::dvec2& where, glm::dvec4& spread) {
              const glm::dvec2 corner = glm::floor(where), f = where - corner;
              const int i = int(corner.x), j = int(corner.y);
              const glm::dvec4 a = fetch(i, j), b = fetch(i + 1, j), c = fetch(i, j + 1),
                               d = fetch(i + 1, j + 1);
              spread = glm::max(glm::max(a, b), glm::max(c, d)) - glm::min(glm::min(a, b), glm::min(c, d));
              return glm::mix(glm::mix(a, b, f.x), glm::mix(c, d, f.x), f.y);
            };
            glm::dvec4 spread(0.0), glowSpread, e(0.0);
            const Image& color = aov(frame, "color", v);
            for (const glm::dvec2& at : places) {
              glm::dvec4 ofPlace;
              e += 0.25 * bilinear([&](int i, int j) { return texel(color, i, j); }, at - 0.5, ofPlace);
              spread = glm::max(spread, ofPlace);
            }
            const glm::dvec4 glow = bilinear([&](int i, int j) { return glows.clamped(i, j); },
                                             (glm::dvec2(x, y) + 0.5) / 4.0 - 0.5, glowSpread);
            e += glm::dvec4(2.5 * tint * std::sqrt(glow.x) * e.w, 0);
            glm::dvec4 g = texel(aov(frame, "", v), x, y);
            g *= glm::dvec4(g.w, g.w, g.w, 1);
            // Vulkan asks for filter weights in steps of 1/256; half floats round by 2^-11 of up to 3.5, and
            // what roots are taken of.
            bool fits = true;
            for (int c = 0; c < 4; ++c) {
              fits &= std::abs(g[c] - e[c]) <=
                      4e-3 + (2 * spread[c] + 1.25 * glowSpread.x / std::sqrt(glow.x + 1e-4)) / 256;
              difference.add(g[c], e[c]);
            }
            wrong += !fits;
          }
        EXPECT_EQ(wrong, 0u) << difference.text() << (aware ? ", depth-aware" : ", paper");
        EXPECT_LT(difference.mean(), 5e-4);
        EXPECT_LT(undecided, size_t(kWidth * kHeight / 20));
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
    Json board = TestScene::unlit("Board", {1, 1, 1, 1}),
         ball = TestScene::unlit("Ball", {0.8f, 0.1f, 0.1f, 1});
    TestMesh mesh;
    for (int y = -20; y < 20; ++y)
      for (int x = -20; x < 20; ++x) {
        append(mesh, gridMesh({0.25f * float(x), 0.25f * float(y), -2}, {0.25f, 0, 0}, {0, 0.25f, 0}),
               (x + y) & 1 ? glm::vec4(0.9f, 0.9f, 0.9f, 1) : glm::vec4(0.05f, 0.05f, 0.05f, 1));
      }
    s.add(mesh, s.material(board));
    if (withBall) s.add(sphereMesh({0, 0, 0}, 1, 32), s.material(ball));
    return s.load();
  };
  const Scene board = makeScene(false), both = makeScene(true);
  const auto perspective = viewsFrom(both, {{0.2f, 0.3f, 4}, {0, 0, 0}, 50}, kWidth, kHeight, GetParam());
  const std::vector<View> parallel(viewCount(), parallelView(1.9f, float(kWidth) / kHeight));
  for (const auto& views : {perspective, parallel}) {
    SCOPED_TRACE(views[0].eyeToClip[2][3] == 0 ? "parallel" : "perspective");
    size_t changed[2] = {}, torn[2] = {};
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
            const glm::dvec4 shown = texel(aov(with, "", v), x, y);
            torn[aware] += (texel(id, x, y).x == 2) != (shown.x > 0.3 && shown.y < 0.3);
            if (texel(id, x, y).x != 1) continue;
            // Outside the displaced silhouette: what the pixel fetches is board on all sides.
            bool onBoard = true;
            for (const glm::dvec2& place : displacedPlaces(aov(with, "warp", v), x, y))
              for (int i = 0; i < 4; ++i)
                onBoard &= texel(id, int(std::floor(place.x - 0.5)) + (i & 1),
                                 int(std::floor(place.y - 0.5)) + (i >> 1))
                               .x == 1;
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
    EXPECT_LE(changed[1], 2u) << "depth-aware";  // a filter's fractions have 8 bits
    EXPECT_GT(torn[1], 50u) << "the ball's own edge";
  }
}

// Before nothing, what keeps still cannot be seen: the picture is the paper's, without a hairline of the old
// silhouette, which samples have given a part of the object, where an edge is torn off.
TEST_P(FinalColorTest, noHairlineIsLeftWhereEdgesAreTornOff) {
  TestScene s;
  Json ball = TestScene::unlit("Ball", {0.9f, 0.05f, 0.05f, 1});
  s.add(sphereMesh({0, 0, 0}, 1, 48), s.material(ball));
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0.4f, 0.5f, 3}, {0, 0, 0}, 50}, kWidth, kHeight, GetParam());
  for (const uint32_t samples : {1u, 4u}) {
    RenderOptions options = sized(kWidth, kHeight, {"id"});
    options.transparent = true;
    options.samples = samples;
    const auto drawn = [&](const char* ripple) {
      return draw(scene,
                  quietLook({{"final.ripple", ripple}, {"warp.amount", "40"}, {"warp.inflation", "50"}}),
                  views, options);
    };
    const Frame paper = drawn("paper"), aware = drawn("depth-aware");
    for (size_t v = 0; v < viewCount(); ++v) {
      size_t left = 0, tornOff = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const double a = texel(aov(paper, "", v), x, y).w, b = texel(aov(aware, "", v), x, y).w;
          left += a < 0.02 && b > 0.1;
          tornOff += texel(aov(paper, "id", v), x, y).x != 0 && a < 0.5;
        }
      EXPECT_GT(tornOff, 50u);
      EXPECT_EQ(left, 0u) << samples << " samples";
    }
  }
}

// Section 4.1: nothing shows an object's colour where its inflated surface does not cover, however far the
// vectors reach.
TEST_P(FinalColorTest, noColourBeyondTheInflatedSurface) {
  TestScene s;
  Json wall = TestScene::unlit("Wall", {0.1f, 0.1f, 0.8f, 1}),
       ball = TestScene::unlit("Ball", {0.9f, 0.05f, 0.05f, 1});
  s.add(gridMesh({-8, -6, -2}, {16, 0, 0}, {0, 12, 0}, 8, {9, 7}), s.material(wall));
  s.add(sphereMesh({0, 0, 0}, 1, 48), s.material(ball));
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0.3f, 0.2f, 5}, {0, 0, 0}, 40}, kWidth, kHeight, GetParam());
  size_t strays[3] = {};
  for (const auto& [mode, name] : {std::pair{0, "paper"}, {1, "depth-aware"}, {2, "layered"}}) {
    // The wall's vectors are long, the ball's inflation is short.
    const Look look = quietLook({{"final.ripple", name}, {"warp.amount", "64"}, {"warp.inflation", "12"}});
    const Frame frame = draw(scene, look, views, sized(kWidth, kHeight, {"warp"}));
    for (size_t v = 0; v < viewCount(); ++v)
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          // Filtering mixes in three neighbours by up to three quarters.
          const bool isRed = texel(aov(frame, "", v), x, y).x > 0.7,
                     isCovered = texel(aov(frame, "warp", v), x, y).w < 6;
          strays[mode] += isRed && !isCovered;
        }
  }
  EXPECT_GT(strays[0], 20u) << "the paper's";
  EXPECT_EQ(strays[1], 0u);
  EXPECT_EQ(strays[2], 0u);
}

// Edges are torn off as far inside a round silhouette as they are torn out, whatever the object's depth.
TEST_P(FinalColorTest, roundSilhouettesAreTornInwardsToo) {
  TestScene s;
  Json ball = TestScene::unlit("Ball", {0.9f, 0.05f, 0.05f, 1});
  s.add(sphereMesh({0, 0, 0}, 1, 64), s.material(ball));
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 3.2f}, {0, 0, 0}, 45}, kWidth, kHeight, GetParam());
  for (const char* ripple : {"depth-aware", "layered"}) {
    const Look look = quietLook({{"final.ripple", ripple}, {"warp.amount", "40"}, {"warp.inflation", "40"}});
    const Frame frame = draw(scene, look, views, sized(kWidth, kHeight, {"id"}));
    for (size_t v = 0; v < viewCount(); ++v) {
      size_t in = 0, out = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const bool isBall = texel(aov(frame, "id", v), x, y).x == 1;
          const glm::dvec4 color = texel(aov(frame, "", v), x, y);
          const bool isRed = color.x > 0.3 && color.y < 0.3;
          in += isBall && !isRed, out += !isBall && isRed;
        }
      EXPECT_GT(in, 60u) << ripple;
      EXPECT_GT(out, 60u) << ripple;
      EXPECT_LT(double(std::max(in, out)) / double(std::min(in, out)), 3.0)
          << ripple << ": " << in << " in, " << out << " out";
    }
  }
}

// Layered: what lies behind stands still inside the silhouette too, where edges are torn off.
TEST_P(FinalColorTest, layeredShowsWhatLiesBehind) {
  // Stripes behind a ball; the ball alone is torn.
  const auto makeScene = [](bool withBall) {
    TestScene s;
    Json stripes = TestScene::unlit("Stripes", {1, 1, 1, 1}),
         ball = TestScene::unlit("Ball", {0.8f, 0.1f, 0.1f, 1});
    TestMesh mesh;
    for (int x = -40; x < 40; ++x) {
      append(mesh, gridMesh({0.15f * float(x), -6, -2}, {0.15f, 0, 0}, {0, 12, 0}),
             x & 1 ? glm::vec4(0.05f, 0.9f, 0.05f, 1) : glm::vec4(0.05f, 0.05f, 0.9f, 1));
    }
    s.add(mesh, s.material(stripes));
    if (withBall) s.add(sphereMesh({0, 0, 0}, 1, 48), s.material(ball));
    return s.load();
  };
  const Scene stripes = makeScene(false), both = makeScene(true);
  const auto views = viewsFrom(both, {{0.2f, 0.3f, 4}, {0, 0, 0}, 50}, kWidth, kHeight, GetParam());
  double wrong[2] = {};
  for (const bool layered : {false, true}) {
    const Look look = quietLook({{"final.ripple", layered ? "layered" : "depth-aware"},
                                 {"warp.amount", "40"},
                                 {"warp.inflation", "40"},
                                 {"materials.Stripes.warp.amount", "0"}});
    const Frame with = draw(both, look, views, sized(kWidth, kHeight, {"id"})),
                without = draw(stripes, look, views, sized(kWidth, kHeight));
    size_t torn = 0, off = 0;
    for (size_t v = 0; v < viewCount(); ++v)
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          if (texel(aov(with, "id", v), x, y).x != 2) continue;
          const glm::dvec4 a = texel(aov(with, "", v), x, y), b = texel(aov(without, "", v), x, y);
          if (a.x > 0.1) continue;  // some of the ball's colour still stands
          ++torn;
          off += std::abs(a.y - b.y) > 0.1;
        }
    EXPECT_GT(torn, 15u);
    wrong[layered] = double(off) / double(torn);
  }
  EXPECT_GT(wrong[0], 0.2) << "stripes come along";
  EXPECT_LT(wrong[1], 0.15) << "stripes stand still";
}

}  // namespace
}  // namespace scumble::passes
