// The chain of four steps against the same in double precision, from the `shadow` and `depth` AOVs.
#include <algorithm>
#include <array>
#include <cmath>

#include "passes/blur/blur_knobs.h"
#include "tests/support/aov.h"
#include "tests/support/render_test.h"

namespace scumble::passes {
namespace {

using namespace test;

// One axis: a Gaussian of `sigma` source texels around the centre of an output texel that spans `factor` of
// them, cut off at two sigma; taps at another depth lose weight. B is depth on both sides.
Texels blurAxis(const Texels& source, bool vertical, int factor, double sigma, double sharpness) {
  Texels out(vertical ? source.width : (source.width + factor - 1) / factor,
             vertical ? (source.height + factor - 1) / factor : source.height);
  const double center = 0.5 * (factor - 1);
  const int reach = std::min(int(std::ceil(2 * sigma)), 31);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const auto along = [&](int i) {
        return vertical ? source.clamped(x, y * factor + i) : source.clamped(x * factor + i, y);
      };
      const double own = along((factor - 1) / 2).z;
      glm::dvec4 sum(0.0);
      double weights = 1e-6;
      for (int i = int(std::ceil(center)) - reach; i <= int(std::floor(center)) + reach; ++i) {
        const double gauss =
            sigma > 0 ? std::exp(-0.5 * (i - center) * (i - center) / (sigma * sigma)) : double(i == center);
        const glm::dvec4 tap = along(i);
        const double z = (tap.z - own) / own, falloff = 1 / (1 + sharpness * z * z);
        sum += gauss * falloff * falloff * tap;
        weights += gauss * falloff * falloff;
      }
      sum /= weights;
      out.at(x, y) = toHalf(glm::dvec4(sum.x, sum.y, own, sum.w));
    }
  return out;
}

class BlurTest : public BothEyes {};
INSTANTIATE_BOTH_EYES(BlurTest);

TEST_P(BlurTest, equalsItsReference) {
  constexpr int kWidth = 160, kHeight = 120;
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
  for (const auto& [radius, depthEdge] : {std::pair{0.0, 0.03}, {9.0, 0.03}, {70.0, 0.0}, {128.0, 0.03}}) {
    const Look look =
        quietLook({{"blur.radius", std::to_string(radius)}, {"blur.depthEdge", std::to_string(depthEdge)}});
    const Frame frame = draw(scene, look, views, sized(kWidth, kHeight, {"shadow", "depth", "blur"}));
    // The plan in the header's words: a standard deviation of half the radius in pixels, two of which go into
    // the steps to a quarter.
    const double wanted = 0.5 * radius * kHeight / 1080.0;
    const double rest = wanted > 2 ? std::sqrt(wanted * wanted - 4) / 4 : 0;
    const double sharpness = depthEdge > 0 ? 0.5 / (depthEdge * depthEdge) : 0;
    for (size_t v = 0; v < viewCount(); ++v) {
      Texels source(kWidth, kHeight);
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          source.at(x, y) = texel(aov(frame, "shadow", v), x, y);
          source.at(x, y).z = std::min(texel(aov(frame, "depth", v), x, y).x, 60000.0);
        }
      Texels expected = blurAxis(blurAxis(source, false, 4, 2, sharpness), true, 4, 2, sharpness);
      expected = blurAxis(blurAxis(expected, false, 1, rest, sharpness), true, 1, rest, sharpness);
      const Texels got = quarterTexels(aov(frame, "blur", v));
      // Half floats lose up to 2^-11 in each of four steps (drivers may truncate); where a depth is rounded
      // the other way, weights at a depth edge follow by up to a percent. Straight colours lose nothing by
      // truncation.
      Difference light(0.01), lens(0.01), coverage(0.01), straight(0.01), depth(2.5e-3);
      for (int y = 0; y < got.height; ++y)
        for (int x = 0; x < got.width; ++x) {
          const glm::dvec4 g = got.clamped(x, y), e = expected.clamped(x, y);
          light.add(g.x * g.w, e.x);
          lens.add(g.y * g.w, e.y);
          coverage.add(g.w, e.w);
          if (e.z > 0) depth.add(g.z / e.z, 1);
          if (e.w > 0.05) straight.add(g.x, e.x / e.w);
        }
      for (const Difference* d : {&light, &lens, &coverage, &straight, &depth}) {
        EXPECT_EQ(d->beyond, 0u) << d->text() << ", radius " << radius << ", view " << v;
        EXPECT_LT(d->mean(), d == &straight ? 6e-4 : 1.5e-3) << d->text();
      }
    }
  }
}

// Sizes that no four divide: the last texel stands for what is left over. The AOV is enlarged linearly,
// straight.
TEST_P(BlurTest, oddSizesEqualTheirReference) {
  constexpr int kWidth = 79, kHeight = 61;
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
  const Frame frame = draw(scene, quietLook({{"blur.radius", "100"}, {"blur.depthEdge", "0"}}), views,
                           sized(kWidth, kHeight, {"shadow", "blur"}));
  const double wanted = 0.5 * 100 * kHeight / 1080.0, rest = std::sqrt(wanted * wanted - 4) / 4;
  for (size_t v = 0; v < viewCount(); ++v) {
    Texels source(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        source.at(x, y) = texel(aov(frame, "shadow", v), x, y);
        source.at(x, y).z = 1;
      }
    Texels small = blurAxis(blurAxis(source, false, 4, 2, 0), true, 4, 2, 0);
    small = blurAxis(blurAxis(small, false, 1, rest, 0), true, 1, rest, 0);
    ASSERT_EQ(small.width, 20);
    ASSERT_EQ(small.height, 16);
    Difference coverage(0.01);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const glm::dvec2 at =
            (glm::dvec2(x, y) + 0.5) * glm::dvec2(small.width, small.height) / glm::dvec2(kWidth, kHeight) -
            0.5;
        const glm::dvec2 corner = glm::floor(at), f = at - corner;
        const auto w = [&](int i, int j) { return small.clamped(int(corner.x) + i, int(corner.y) + j).w; };
        coverage.add(texel(aov(frame, "blur", v), x, y).w,
                     glm::mix(glm::mix(w(0, 0), w(1, 0), f.x), glm::mix(w(0, 1), w(1, 1), f.x), f.y));
      }
    EXPECT_EQ(coverage.beyond, 0u) << coverage.text() << ", view " << v;
  }
}

// A step of the light on one plane: its blurred profile has the standard deviation that the knob asks for.
TEST_F(BlurTest, spreadsByHalfTheRadius) {
  constexpr int kWidth = 256, kHeight = 64;
  TestScene s;
  // Left half unlit, and so in full light; right half facing away from the light.
  s.add(gridMesh({-8, -3, 0}, {8, 0, 0}, {0, 6, 0}), s.material(TestScene::unlit("Bright", {1, 1, 1, 1})));
  s.add(gridMesh({0, -3, 0}, {8, 0, 0}, {0, 6, 0}), s.material(TestScene::colored("Dark", {1, 1, 1, 1})));
  s.light({0, 0.2f, -1});
  const Scene scene = s.load();
  for (const double pixels : {6.0, 7.5}) {
    const Look look = quietLook({{"blur.radius", std::to_string(pixels * 1080 / kHeight)}});
    const Frame frame = draw(scene, look, {parallelView(1, 4)}, sized(kWidth, kHeight, {"blur"}));
    const Texels got = quarterTexels(aov(frame, "blur"));
    double mass = 0, mean = 0, square = 0;
    for (int x = 1; x < got.width; ++x) {
      const double step = got.clamped(x - 1, 8).x - got.clamped(x, 8).x, at = 4 * x;
      mass += step, mean += step * at, square += step * at * at;
    }
    EXPECT_NEAR(mass, 1, 0.01);
    EXPECT_NEAR(mean / mass, 128, 0.1);
    // The Gaussians are cut off at two sigma, which takes a tenth.
    EXPECT_NEAR(std::sqrt(square / mass - mean * mean / mass / mass), 0.5 * pixels, 0.12 * 0.5 * pixels);
  }
}

}  // namespace
}  // namespace scumble::passes
