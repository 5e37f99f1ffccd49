// A picture behind everything, and the ground that shows only shadows, against the same in double precision.
#include <algorithm>
#include <cmath>

#include "base/oklab.h"
#include "passes/limit/limit_knobs.h"
#include "tests/support/aov.h"
#include "tests/support/palette_reference.h"
#include "tests/support/render_test.h"
#include "tests/support/sanitized.h"

namespace scumble::passes {
namespace {

using namespace test;

class BackdropTest : public BothEyes {
 protected:
  static constexpr int kWidth = 160, kHeight = 120;

  // Colours that change from pixel to pixel, or slowly.
  static std::shared_ptr<Image> picture(uint32_t width, uint32_t height, bool fine) {
    auto image = std::make_shared<Image>();
    image->width = width, image->height = height;
    image->channels = {"R", "G", "B"};
    for (uint32_t y = 0; y < height; ++y)
      for (uint32_t x = 0; x < width; ++x) {
        const float u = (float(x) + 0.5f) / float(width), v = (float(y) + 0.5f) / float(height);
        const uint32_t noise = (x * 2654435761u ^ y * 2246822519u) >> 7;
        const auto part = [&](uint32_t shift) {
          return fine ? 0.2f * float(noise >> shift & 0xFF) / 255.0f : 0.0f;
        };
        for (const float value :
             {0.2f + 0.5f * u + part(0), 0.3f + 0.3f * v + part(8), 0.6f - 0.4f * u + part(16)})
          image->pixels.push_back(value);
      }
    return image;
  }

  // Nothing of the style acts on the picture.
  static Look pictureLook(std::vector<std::pair<std::string, std::string>> knobs = {}) {
    std::vector<std::pair<std::string, std::string>> all{
        {"background.style", "0"}, {"background.simplify", "0"}, {"ground.mode", "auto"}};
    all.insert(all.end(), knobs.begin(), knobs.end());
    return quietLook(all);
  }

  // A ball over the ground.
  static Scene ball() {
    TestScene s;
    Json paint = TestScene::colored("Ball", {0.8f, 0.2f, 0.1f, 1});
    s.add(sphereMesh({0, 1.3f, 0}, 1, 32), s.material(paint));
    s.light({0.5f, 1, 0.3f});
    return s.load();
  }
};
INSTANTIATE_BOTH_EYES(BackdropTest);

TEST_P(BackdropTest, coloursInShadowAreTheRulesAndAllElseIsThePicture) {
  const Scene scene = ball();
  const auto views = viewsFrom(scene, {{1, 3, 7}, {0, 0.6f, 0}, 50}, kWidth, kHeight, GetParam());
  PaletteReference plain;
  plain.darkest = 0, plain.lightest = 1, plain.litTintAmount = 0;
  const FitReference rule([&](const glm::dvec3& c) { return plain.shadowed(c); });
  const glm::dvec3 tint = skyTintReference(0.1, 1);  // the ground looks up
  const auto backdrop = picture(kWidth, kHeight, true);
  for (const uint32_t samples : {1u, 4u}) {
    RenderOptions options = sized(kWidth, kHeight, {"color", "final-shadow", "lit", "shadow"}, samples);
    options.background = backdrop;
    const Frame frame = draw(scene, pictureLook({{"warp.amount", "0"}}), views, options);
    for (size_t v = 0; v < viewCount(); ++v) {
      Difference difference(2e-3);
      size_t dark = 0, exact = 0;
      const auto clamped = [&](const char* name, int x, int y) {
        return texel(aov(frame, name, v), std::clamp(x, 0, kWidth - 1), std::clamp(y, 0, kHeight - 1));
      };
      const auto matteAt = [&](int x, int y) {
        return std::max(clamped("shadow", x, y).w - clamped("color", x, y).w, 0.0) *
               (1 - clamped("final-shadow", x, y).x);
      };
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const glm::dvec4 got = texel(aov(frame, "", v), x, y), front = texel(aov(frame, "color", v), x, y);
          const glm::dvec3 own(texel(*backdrop, x, y));
          const double matte = matteAt(x, y);
          const glm::dvec3 shadowed = rule(own) * tint;
          const glm::dvec3 expected =
              glm::dvec3(front) * front.w + own * (1 - front.w - matte) + shadowed * matte;
          for (int c = 0; c < 3; ++c) difference.add(got[c], expected[c]);
          EXPECT_EQ(got.w, 1.0);
          dark += matte > 0.7;
          // Where nothing is beside it either, of which filters would add what they round.
          double around = 0;
          for (int k = 0; k < 9; ++k)
            around +=
                matteAt(x + k % 3 - 1, y + k / 3 - 1) + clamped("color", x + k % 3 - 1, y + k / 3 - 1).w;
          if (around == 0) {
            ++exact;
            for (int c = 0; c < 3; ++c) EXPECT_EQ(got[c], toHalf(own[c])) << x << ", " << y;
          }
        }
      EXPECT_EQ(difference.beyond, 0u) << difference.text() << ", " << samples << " samples, view " << v;
      EXPECT_GT(dark, 120u);
      EXPECT_GT(exact, 5000u);
    }
  }
}

// Whatever its size: the middle in the middle, no borders, the aspect kept; the same for both eyes.
TEST_P(BackdropTest, coversTheFrame) {
  const Scene scene = ball();
  const auto views = viewsFrom(scene, {{1, 3, 7}, {0, 0.6f, 0}, 50}, kWidth, kHeight, GetParam());
  for (const glm::uvec2 size : {glm::uvec2(400, 100), glm::uvec2(90, 320), glm::uvec2(999, 777)}) {
    RenderOptions options = sized(kWidth, kHeight, {"color"});
    options.background = picture(size.x, size.y, false);
    const Look look = pictureLook({{"ground.mode", "off"}, {"warp.amount", "0"}});
    const Frame frame = draw(scene, look, views, options);
    const double scale = std::min(size.x / double(kWidth), size.y / double(kHeight));
    for (size_t v = 0; v < viewCount(); ++v) {
      Difference difference(6e-3);
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          if (texel(aov(frame, "color", v), x, y).w > 0) continue;
          const double u = 0.5 + (x + 0.5 - kWidth / 2.0) * scale / size.x;
          const double w = 0.5 + (y + 0.5 - kHeight / 2.0) * scale / size.y;
          const glm::dvec3 expected(0.2 + 0.5 * u, 0.3 + 0.3 * w, 0.6 - 0.4 * u);
          for (int c = 0; c < 3; ++c) difference.add(texel(aov(frame, "", v), x, y)[c], expected[c]);
        }
      EXPECT_GT(difference.count, 30000u);
      EXPECT_EQ(difference.beyond, 0u) << difference.text() << ", " << size.x << "x" << size.y;
    }
  }
}

// With `none` the picture stays where it is, though shadows and silhouettes are torn; with `everywhere` it is
// torn far from them too, alike for both eyes.
TEST_P(BackdropTest, warpIsWhereItIsAskedFor) {
  NOT_WITH_SANITIZERS();
  const Scene scene = ball();
  const auto views = viewsFrom(scene, {{1, 3, 7}, {0, 0.6f, 0}, 50}, kWidth, kHeight, GetParam());
  RenderOptions options = sized(kWidth, kHeight, {"warp", "color"});
  options.background = picture(kWidth, kHeight, true);
  const auto moved = [&](const char* where, size_t v, bool besideSurfaces) {
    const Look look = pictureLook({{"background.warp", where},
                                   {"warp.amount", "30"},
                                   {"warp.inflation", "30"},
                                   {"final.ripple", "paper"},
                                   {"shadowMap.cast", "false"}});
    const Frame frame = draw(scene, look, views, options);
    size_t count = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const glm::dvec4 got = texel(aov(frame, "", v), x, y), own = texel(*options.background, x, y);
        const double surface = texel(aov(frame, "warp", v), x, y).w;
        if (texel(aov(frame, "color", v), x, y).w > 0 || (surface > 0) != besideSurfaces) continue;
        // What is torn out of the ball is no picture at all.
        count += std::abs(got.x - own.x) > 0.02 && got.z > 0.25;
      }
    return count;
  };
  for (size_t v = 0; v < viewCount(); ++v) {
    // At silhouettes colours of the ball are mixed in.
    EXPECT_GT(moved("near", v, true), 100u);
    EXPECT_LT(3 * moved("none", v, true), moved("near", v, true));
    EXPECT_EQ(moved("none", v, false), 0u);
    EXPECT_EQ(moved("near", v, false), 0u);
    EXPECT_GT(moved("everywhere", v, false), 500u);
  }
}

TEST_P(BackdropTest, styleIsTheRuleInLight) {
  const Scene scene = ball();
  const auto views = viewsFrom(scene, {{1, 3, 7}, {0, 0.6f, 0}, 50}, kWidth, kHeight, GetParam());
  RenderOptions options = sized(kWidth, kHeight, {"color"});
  options.background = picture(kWidth, kHeight, true);
  const Frame frame =
      draw(scene, pictureLook({{"ground.mode", "off"}, {"warp.amount", "0"}, {"background.style", "0.5"}}),
           views, options);
  const FitReference rule([](const glm::dvec3& c) { return PaletteReference().lit(c); });
  Difference difference(2e-3);
  for (size_t v = 0; v < viewCount(); ++v)
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        if (texel(aov(frame, "color", v), x, y).w > 0) continue;
        const glm::dvec3 own(texel(*options.background, x, y));
        const glm::dvec3 expected = glm::mix(own, rule(own), 0.5);
        for (int c = 0; c < 3; ++c) difference.add(texel(aov(frame, "", v), x, y)[c], expected[c]);
      }
  EXPECT_GT(difference.count, 30000 * viewCount());
  EXPECT_EQ(difference.beyond, 0u) << difference.text();
}

// A film: another picture in each frame, two frames under way, sizes that change; then the first one again.
TEST_F(BackdropTest, eachFrameHasItsOwnPicture) {
  const Scene scene = ball();
  const auto views = viewsFrom(scene, {{1, 3, 7}, {0, 0.6f, 0}, 50}, kWidth, kHeight);
  const Look look = pictureLook();
  const auto optionsOf = [&](int i) {
    RenderOptions options = sized(kWidth, kHeight);
    const uint32_t size = i == 3 ? 200 : kWidth;
    auto image = picture(size, size, false);
    for (float& value : image->pixels) value *= 0.2f * float(i % 4 + 1);
    options.background = image;
    return options;
  };
  std::vector<Frame> alone;
  for (int i = 0; i < 5; ++i) alone.push_back(draw(scene, look, views, optionsOf(i)));
  std::vector<Frame> row;
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(renderer().begin(scene, look, 0, views, optionsOf(i)));
    if (i > 0) row.push_back(std::move(renderer().finish()).value());
  }
  row.push_back(std::move(renderer().finish()).value());
  for (size_t i = 0; i < 5; ++i)
    EXPECT_TRUE(sameBytes(alone[i].layers[0].views[0], row[i].layers[0].views[0])) << i;
  EXPECT_FALSE(sameBytes(alone[0].layers[0].views[0], alone[1].layers[0].views[0]));
  EXPECT_TRUE(sameBytes(alone[0].layers[0].views[0], alone[4].layers[0].views[0]));

  RenderOptions bad = sized(kWidth, kHeight);
  auto image = picture(4, 4, false);
  image->pixels.pop_back();
  bad.background = image;
  EXPECT_FALSE(renderer().render(scene, look, 0, views, bad));
}

// Paper 000, section 7.4: a background is made consistent with the style. Flat shapes of few colours, whose
// edges stay.
TEST_P(BackdropTest, isPaintedInFlatShapes) {
  const Scene scene = ball();
  const auto views = viewsFrom(scene, {{1, 3, 7}, {0, 0.6f, 0}, 50}, kWidth, kHeight, GetParam());
  RenderOptions options = sized(kWidth, kHeight, {"id"});
  options.background = picture(kWidth, kHeight, false);
  const auto lightnessOf = [&](const char* steps) {
    const Frame frame =
        draw(scene, pictureLook({{"ground.mode", "off"}, {"warp.amount", "0"}, {"background.steps", steps}}),
             views, options);
    std::vector<double> lightness;
    for (size_t v = 0; v < viewCount(); ++v)
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
          if (texel(aov(frame, "id", v), x, y).x == 0)
            lightness.push_back(oklabFromLinear(glm::dvec3(texel(aov(frame, "", v), x, y))).x);
    return lightness;
  };
  const std::vector<double> own = lightnessOf("0");
  for (const int steps : {3, 6, 12}) {
    const std::vector<double> flat = lightnessOf(std::to_string(steps).c_str());
    ASSERT_EQ(flat.size(), own.size());
    size_t onStep = 0;
    double farthest = 0;
    for (size_t i = 0; i < flat.size(); ++i) {
      const double at = flat[i] * steps - 0.5;
      onStep += std::abs(at - std::round(at)) < 0.03;
      farthest = std::max(farthest, std::abs(flat[i] - own[i]));
    }
    EXPECT_GT(double(onStep), 0.85 * double(flat.size())) << steps;
    EXPECT_LT(farthest, 0.5 / steps + 0.02) << steps;
  }
}

// In the palette that the rest of the picture has, in light and in the ground's shadow; `limit.backdrop`
// takes it back.
TEST_P(BackdropTest, isLimitedToThePalette) {
  const Scene scene = ball();
  const auto views = viewsFrom(scene, {{1, 3, 7}, {0, 0.6f, 0}, 50}, kWidth, kHeight, GetParam());
  RenderOptions options = sized(kWidth, kHeight, {"id"});
  options.background = picture(kWidth, kHeight, false);
  const auto toLinear = [](uint32_t code) {
    glm::dvec3 linear;
    for (int c = 0; c < 3; ++c) {
      const double s = double(code >> (16 - 8 * c) & 255) / 255;
      linear[c] = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    }
    return linear;
  };
  std::vector<glm::dvec3> palette;
  for (const uint32_t code : builtInPalette(kFirstBuiltIn + 1)) palette.push_back(toLinear(code));
  const Knobs limited{{"limit.palette", "dusk"}, {"warp.amount", "0"}};
  const auto drawn = [&](Knobs knobs, const Knobs& more) {
    knobs.insert(knobs.end(), more.begin(), more.end());
    return draw(scene, pictureLook(knobs), views, options);
  };
  for (const char* ground : {"on", "off"}) {
    const Frame all = drawn(limited, {{"ground.mode", ground}}),
                none = drawn(limited, {{"ground.mode", ground}, {"limit.backdrop", "0"}}),
                plain = drawn({{"warp.amount", "0"}}, {{"ground.mode", ground}});
    for (size_t v = 0; v < viewCount(); ++v) {
      size_t count = 0, inPalette = 0, before = 0, same = 0;
      std::vector<bool> used(palette.size());
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          if (texel(aov(all, "id", v), x, y).x != 0) continue;
          ++count;
          const auto nearest = [&](const Frame& frame) {
            double least = 1e9;
            for (size_t i = 0; i < palette.size(); ++i) {
              const double away = glm::distance(glm::dvec3(texel(aov(frame, "", v), x, y)), palette[i]);
              least = std::min(least, away);
              if (&frame == &all && away < 0.004) used[i] = true;
            }
            return least < 0.004;
          };
          inPalette += nearest(all), before += nearest(none);
          same += texel(aov(none, "", v), x, y) == texel(aov(plain, "", v), x, y);
        }
      EXPECT_GT(count, 3000u);
      EXPECT_GT(double(inPalette), 0.8 * double(count)) << ground;
      EXPECT_LT(double(before), 0.3 * double(count)) << ground;
      EXPECT_GE(std::count(used.begin(), used.end(), true), 2) << ground;
      if (std::string(ground) == "off") {
        EXPECT_EQ(same, count);
      }
    }
  }
}

}  // namespace
}  // namespace scumble::passes
