// Few colours against the same in double precision, from the `color`, `warp` and `depth` AOVs; the distances
// by trying all colours.
#include <algorithm>
#include <cmath>
#include <limits>

#include "passes/limit/limit_knobs.h"
#include "tests/support/aov.h"
#include "tests/support/palette_reference.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"
#include "tests/support/sanitized.h"
#include "world/example_textures.h"

namespace scumble::passes {
namespace {

using namespace test;

// The look's own are the knobs' defaults; docs/palette.md says how many each of the others has.
std::vector<glm::dvec3> linearPalette(const LimitParams& knobs) {
  constexpr uint32_t kOfTheLook[] = {0xF3E3C3, 0x1F3A52, 0x3F8F96, 0xC98A52, 0x9C9BB4, 0x7FB0AE,
                                     0x6B4238, 0xC8442F, 0xB9C7B6, 0xE6BE8A, 0x2E6474, 0x545A7C,
                                     0x96613E, 0x7D8A62, 0x14202E, 0xFFF6E4};
  const int palette = int(knobs.palette);
  std::vector<glm::dvec3> colors;
  if (palette == 1) {
    for (int i = 0; i < knobs.colors; ++i) colors.push_back(referenceColor(kOfTheLook[i]));
    return colors;
  }
  for (const uint32_t color : builtInPalette(palette)) colors.push_back(referenceColor(color));
  constexpr size_t kCounts[] = {6, 11, 10, 10};
  EXPECT_EQ(colors.size(), kCounts[palette - 2]);
  return colors;
}

// The nearest colour of a palette.
size_t nearestTo(const glm::dvec3& linear, const std::vector<glm::dvec3>& palette) {
  size_t best = 0;
  for (size_t i = 1; i < palette.size(); ++i)
    if (glm::distance(referenceLab(linear), referenceLab(palette[i])) <
        glm::distance(referenceLab(linear), referenceLab(palette[best])))
      best = i;
  return best;
}

class LimitTest : public BothEyes {
 protected:
  static constexpr int kWidth = 160, kHeight = 120;

  static Look lookOf(const LimitParams& k, const std::string& palette) {
    return quietLook({{"limit.palette", palette},
                      {"limit.amount", std::to_string(k.amount)},
                      {"limit.dither", std::to_string(k.dither)},
                      {"limit.skyDither", std::to_string(k.skyDither)},
                      {"limit.lightness", std::to_string(k.lightness)},
                      {"limit.softness", std::to_string(k.softness)},
                      {"limit.colors", std::to_string(k.colors)}});
  }

  static glm::dvec3 straight(const Image& image, int x, int y) {
    return texel(image, std::clamp(x, 0, kWidth - 1), std::clamp(y, 0, kHeight - 1));
  }

  // Before edges are mended; the sky has no marks.
  static glm::dvec3 limited(const LimitParams& k, const std::vector<glm::dvec3>& palette, const Frame& frame,
                            size_t view, int x, int y) {
    const glm::dvec3 weights(k.lightness, 1, 1);
    const auto labAt = [&](int px, int py) {
      return weights * referenceLab(glm::max(straight(aov(frame, "color", view), px, py), 0.0));
    };
    const glm::dvec3 own = labAt(x, y);
    const auto distance = [&](const glm::dvec3& color) {
      return glm::distance(own, weights * referenceLab(color));
    };
    const glm::dvec3 nearest =
        weights * referenceLab(*std::min_element(palette.begin(), palette.end(), [&](auto& a, auto& b) {
          return distance(a) < distance(b);
        }));
    glm::dvec3 beside = nearest;
    double farthest = 0;
    for (const glm::dvec3& color : palette) {
      const glm::dvec3 way = weights * referenceLab(color) - nearest;
      const double part = glm::dot(way, way) > 1e-12 ? glm::dot(own - nearest, way) / glm::dot(way, way) : 0;
      if (part > farthest) farthest = part, beside = nearest + way;
    }
    const bool isDarker = beside.x < nearest.x;
    const glm::dvec3 dark = isDarker ? beside : nearest, way = (isDarker ? nearest : beside) - dark;
    const glm::dvec3 along = way / std::max(glm::dot(way, way), 1e-8);

    const Image& warp = aov(frame, "warp", view);
    const bool surface = texel(warp, x, y).w > 0 && texel(aov(frame, "depth", view), x, y).x < 1e30;
    const double near = 1 - smoothstep(0.13, 0.20, std::hypot(way.y, way.z));
    // How far the colour goes within 12 pixels at 1080 lines, by the derivative of OKLab; 0: flat.
    const auto part = [&](int dx, int dy) {
      const double h = 1e-4;
      const glm::dvec3 at = glm::max(straight(aov(frame, "color", view), x, y), 0.0);
      const glm::dvec3 step = straight(aov(frame, "color", view), x + dx, y + dy) - at;
      return glm::dot(weights * (referenceLab(at + h * step) - referenceLab(at)) / h, along);
    };
    const auto drifts = [&](int dx, int dy) {
      const double middle = part(dx / 2, dy / 2), whole = part(dx, dy);
      const double p = 2 * std::min(std::abs(middle), std::abs(whole - middle));
      return smoothstep(0.005, 0.03, p) * (1 - smoothstep(0.3, 0.6, p));
    };
    const int reach = std::max(int(std::lround(12.0 * kHeight / 1080)), 2);
    const double dither = surface ? 0.8 * near * std::max(drifts(reach, 0), drifts(0, reach)) * k.dither : 0;
    const double beyond = glm::dot(own - dark, along) - 0.5 + dither * (texel(warp, x, y).z - 0.5);
    // How both change towards the next pixels.
    const auto slope = [&](int dx, int dy) {
      const int nx = std::min(x + dx, kWidth - 1), ny = std::min(y + dy, kHeight - 1);
      return part(dx, dy) + dither * (texel(warp, nx, ny).z - texel(warp, x, y).z);
    };
    const double width = std::clamp(0.5 * k.softness * std::hypot(slope(1, 0), slope(0, 1)), 1e-5, 0.1);
    const glm::dvec3 snapped = dark + way * std::clamp(0.5 + 0.5 * beyond / width, 0.0, 1.0);
    return glm::max(referenceLinear(glm::mix(own, snapped, double(k.amount)) / weights), 0.0);
  }

  // The whole picture, edges mended.
  static Texels expected(const LimitParams& k, const Frame& frame, size_t view) {
    Texels first(kWidth, kHeight), result(kWidth, kHeight);
    const std::vector<glm::dvec3> palette = linearPalette(k);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        if (texel(aov(frame, "color", view), x, y).w > 0)  // else black, and not there
          first.at(x, y) = toHalf(glm::dvec4(limited(k, palette, frame, view, x, y), 1));
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const auto root = [&](int px, int py) {
          return glm::sqrt(straight(aov(frame, "color", view), px, py));
        };
        const bool upright =
            glm::distance(root(x, y - 1), root(x, y + 1)) > glm::distance(root(x - 1, y), root(x + 1, y));
        const int dx = upright ? 0 : 1, dy = upright ? 1 : 0;
        const glm::dvec3 from = root(x - dx, y - dy), way = root(x + dx, y + dy) - from,
                         toOwn = root(x, y) - from;
        const double squared = std::max(glm::dot(way, way), 1e-6);
        const double part = std::clamp(glm::dot(toOwn, way) / squared, 0.0, 1.0);
        const glm::dvec3 off = toOwn - part * way;
        const double mends = k.softness > 0 ? smoothstep(0.06, 0.10, glm::length(way)) *
                                                  (1 - smoothstep(0.01, 0.04, glm::dot(off, off) / squared))
                                            : 0;
        const glm::dvec3 mixed = glm::mix(glm::sqrt(glm::dvec3(first.clamped(x - dx, y - dy))),
                                          glm::sqrt(glm::dvec3(first.clamped(x + dx, y + dy))), part);
        result.at(x, y) = glm::dvec4(glm::mix(glm::dvec3(first.at(x, y)), mixed * mixed, mends), 1);
      }
    return result;
  }
};
INSTANTIATE_BOTH_EYES(LimitTest);

TEST_P(LimitTest, equalsItsReference) {
  NOT_WITH_SANITIZERS();
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
  struct Case {
    const char* palette;
    double amount, dither, lightness, softness;
    int colors;
    bool transparent = false;
  };
  for (const Case& c : {Case{"look", 1, 0.25, 1, 1, 12},
                        {"dusk", 1, 1, 0.5, 2, 1},
                        {"dusk", 1, 0.25, 1, 1, 1, true},
                        {"four-blues", 0.6, 0, 2, 0, 1},
                        {"look", 1, 0.5, 1, 1, 3},
                        {"look", 1, 0.5, 1, 1, 16}}) {
    LimitParams k;
    const std::vector<std::string> names = look::choiceNames(LimitParams::block().rows[0]);
    k.palette = double(std::find(names.begin(), names.end(), c.palette) - names.begin());
    k.amount = float(c.amount), k.dither = float(c.dither), k.lightness = float(c.lightness);
    k.softness = float(c.softness), k.skyDither = 0, k.colors = c.colors;
    RenderOptions options = sized(kWidth, kHeight, {"color", "warp", "depth", "limit"}, 4);
    options.transparent = c.transparent;
    const Frame frame = draw(scene, lookOf(k, c.palette), views, options);
    for (size_t v = 0; v < viewCount(); ++v) {
      const Texels e = expected(k, frame, v);
      Difference difference(4e-3);
      size_t partly = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const glm::dvec4 got = texel(aov(frame, "limit", v), x, y);
          partly += got.w > 0 && got.w < 1;
          for (int i = 0; i < 3 && got.w > 0; ++i) difference.add(got[i], e.clamped(x, y)[i]);
        }
      EXPECT_GE(partly, c.transparent ? 100u : 0u);
      // Half floats of colours decide for one side or the other where two are equally near.
      EXPECT_LT(difference.beyondPart(), 2e-3) << c.palette << ": " << difference.text();
      EXPECT_LT(difference.mean(), 5e-4) << c.palette << ": " << difference.text();
    }
  }
}

// Left out of the frame, or asked for but off: the picture keeps its bytes, and `limit` those of `color`.
TEST_P(LimitTest, offIsOffToTheBit) {
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
  for (const char* ripple : {"depth-aware", "layered"}) {
    const Look off = quietLook({{"final.ripple", ripple}});
    const Look none = quietLook({{"final.ripple", ripple}, {"limit.palette", "dusk"}, {"limit.amount", "0"}});
    const Frame plain = draw(scene, off, views, sized(kWidth, kHeight, {"color"}, 4));
    const Frame asked = draw(scene, off, views, sized(kWidth, kHeight, {"limit"}, 4));
    const Frame zero = draw(scene, none, views, sized(kWidth, kHeight, {}, 4));
    for (size_t v = 0; v < viewCount(); ++v) {
      EXPECT_TRUE(sameBytes(aov(plain, "", v), aov(asked, "", v)));
      EXPECT_TRUE(sameBytes(aov(plain, "", v), aov(zero, "", v)));
      EXPECT_TRUE(sameBytes(aov(plain, "color", v), aov(asked, "limit", v)));
    }
  }
}

// Patches that are painted in the palette's own colours, on a background of one of them.
TEST_P(LimitTest, thePalettesOwnColorsStay) {
  LimitParams k;
  for (k.palette = 1; k.palette < 6; k.palette = double(k.palette + 1)) {
    const std::string name = look::choiceNames(LimitParams::block().rows[0])[size_t(int(k.palette))];
    TestScene s;
    const std::vector<glm::dvec3> palette = linearPalette(k);
    for (size_t i = 0; i < palette.size(); ++i) {
      const size_t column = i % 4, row = i / 4;
      s.add(gridMesh({-2 + float(column), -1.5f + float(row), 0}, {0.9f, 0, 0}, {0.1f, 0.9f, 0}),
            s.material(TestScene::unlit("Patch", glm::vec4(glm::vec3(palette[i]), 1))));
    }
    const Scene scene = s.load();
    const auto views = viewsFrom(scene, {{0, 0, 5}}, kWidth, kHeight, GetParam());
    Look look = lookOf(k, name);
    ASSERT_TRUE(look.set("limit.dither", "1"));
    ASSERT_TRUE(look.set("limit.skyDither", "1"));
    for (const char* side : {"background.horizon", "background.zenith"})
      ASSERT_TRUE(look.set(side, k.palette == 1   ? "#F3E3C3"
                                 : k.palette == 2 ? "#F4EBD6"
                                 : k.palette == 3 ? "#FBE8C8"
                                 : k.palette == 4 ? "#E9DFB4"
                                                  : "#F1E7CF"));
    const Frame frame = draw(scene, look, views, sized(kWidth, kHeight, {"color", "limit"}, 4));
    // Anti-aliased edges between them stay as well; 8 bits in the surfaces' colours, as square roots.
    for (size_t v = 0; v < viewCount(); ++v) {
      Difference difference(0.02);
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
          for (int i = 0; i < 3; ++i)
            difference.add(texel(aov(frame, "limit", v), x, y)[i], texel(aov(frame, "color", v), x, y)[i]);
      EXPECT_LT(difference.beyondPart(), 0.015) << name << ": " << difference.text();
    }
  }
}

// Flat, unlit colours and nothing between them: only the palette's are left, the nearest ones where no marks
// decide.
TEST_P(LimitTest, onlyThePalettesColorsAreLeft) {
  TestScene s;
  for (int i = 0; i < 12; ++i) {
    const int column = i % 4, row = i / 4;
    s.add(gridMesh({-2 + float(column), -1.5f + float(row), 0}, {1, 0, 0}, {0, 1, 0}),
          s.material(TestScene::unlit("Patch",
                                      {0.08f * float(i), 0.9f - 0.07f * float(i), 0.1f * float(i % 5), 1})));
  }
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 5}}, kWidth, kHeight, GetParam());
  for (const double dither : {0.0, 1.0}) {
    LimitParams k;
    k.palette = 1, k.dither = k.skyDither = float(dither), k.softness = 0;
    const std::vector<glm::dvec3> palette = linearPalette(k);
    const Frame frame = draw(scene, lookOf(k, "look"), views, sized(kWidth, kHeight, {"color", "limit"}));
    for (size_t v = 0; v < viewCount(); ++v) {
      size_t others = 0, notNearest = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const glm::dvec3 got(texel(aov(frame, "limit", v), x, y));
          const glm::dvec3 found = palette[nearestTo(got, palette)];
          others += glm::length(got - found) > 1.5e-3;
          const glm::dvec3 nearest = palette[nearestTo(texel(aov(frame, "color", v), x, y), palette)];
          notNearest += glm::length(got - nearest) > 1.5e-3;
        }
      EXPECT_LE(others, 2u);  // where two are equally near
      if (dither == 0)
        EXPECT_EQ(notNearest, 0u);
      else
        EXPECT_GT(notNearest, 200u);
    }
  }
}

// Coverage is as it was, and colours are straight: what is half there goes where the whole of it goes.
TEST_P(LimitTest, transparentPicturesKeepTheirCoverage) {
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
  RenderOptions options = sized(kWidth, kHeight, {"color", "limit"}, 4);
  options.transparent = true;
  LimitParams k;
  k.palette = 3, k.dither = 0, k.softness = 0;
  const std::vector<glm::dvec3> palette = linearPalette(k);
  const Frame frame = draw(scene, lookOf(k, "dusk"), views, options);
  for (size_t v = 0; v < viewCount(); ++v) {
    size_t partly = 0, farther = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const glm::dvec4 before = texel(aov(frame, "color", v), x, y),
                         after = texel(aov(frame, "limit", v), x, y);
        EXPECT_EQ(before.w, after.w);
        if (before.w == 0) continue;
        partly += before.w < 1;
        EXPECT_LT(glm::length(glm::dvec3(after) - palette[nearestTo(after, palette)]), 4e-3);
        farther += nearestTo(after, palette) != nearestTo(before, palette);
      }
    EXPECT_GT(partly, 50u);
    EXPECT_LE(farther, partly / 50);  // where two are equally near
  }
}

// Marks in the sky stand still in the world: both eyes, and a camera that has turned, see the same ones.
TEST_F(LimitTest, marksInTheSkyStandStillInTheWorld) {
  TestScene s;
  s.add(sphereMesh({0, -9, 0}, 0.5f, 8), s.material(TestScene::colored("Grey", {0.5f, 0.5f, 0.5f, 1})));
  const Scene scene = s.load();
  LimitParams k;
  k.skyDither = 1;
  const Look look = lookOf(k, "look");
  const auto straightOn = viewsFrom(scene, {{0, 0, 5}, {0, 1, 0}}, kWidth, kHeight);
  const auto turned = viewsFrom(scene, {{0, 0, 5}, {0.8f, 1.2f, 0}}, kWidth, kHeight);
  const Frame a = draw(scene, look, straightOn, sized(kWidth, kHeight, {"limit"}));
  const Frame b = draw(scene, look, turned, sized(kWidth, kHeight, {"limit"}));
  size_t compared = 0, differing = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const auto ray = pixelRay(straightOn[0], x, y, kWidth, kHeight);
      const glm::dvec2 at = pixelOf(turned[0], glm::dvec3(0, 0, 5) + 1000.0 * ray.direction, kWidth, kHeight);
      if (at.x < 1 || at.y < 1 || at.x > kWidth - 1 || at.y > kHeight - 1) continue;
      ++compared;
      differing +=
          glm::distance(texel(aov(a, "limit"), x, y), texel(aov(b, "limit"), int(at.x), int(at.y))) > 0.1;
    }
  EXPECT_GT(compared, 5000u);
  EXPECT_LT(double(differing) / double(compared), 0.1);  // pixels are not where they were
}

TEST_P(LimitTest, fragmentAndComputeAgree) {
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
  const Look look = quietLook({{"limit.palette", "dusk"}, {"final.ripple", "layered"}});
  const RenderOptions options = sized(kWidth, kHeight, {"color", "limit"}, 4);
  const Frame a = draw(scene, look, views, options);
  const Frame b = otherRenderer().render(scene, look, 0, views, options).value();
  for (size_t v = 0; v < viewCount(); ++v) {
    Difference difference(2e-3);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        for (int i = 0; i < 3; ++i)
          difference.add(texel(aov(a, "limit", v), x, y)[i], texel(aov(b, "limit", v), x, y)[i]);
    EXPECT_LT(difference.beyondPart(), 1e-3) << difference.text();
  }
}

}  // namespace
}  // namespace scumble::passes
