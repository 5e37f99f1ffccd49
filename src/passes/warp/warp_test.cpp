// MetaTexture and the warp vectors: FORMULAS 1 (pairing), 2 (contrast), 3 (gradients) and 9 (camera roll),
// and all of it against the same in double precision, from the `uv` and `uv-gradient` AOVs.
#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "frame/metatexture.h"
#include "passes/warp/warp_knobs.h"
#include "tests/support/aov.h"
#include "tests/support/metatexture_reference.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"
#include "tests/support/test_device.h"

namespace scumble::passes {
namespace {

using namespace test;

double bfloat(double value) {
  return std::bit_cast<float>((std::bit_cast<uint32_t>(float(value)) + 0x8000u) & 0xFFFF0000u);
}

// The level of the example that is drawn at a size in pixels, by means of 2 x 2.
Pixels mipLevel(Pixels pixels, double size) {
  for (int level = int(std::max(0.0, std::floor(std::log2(pixels.width / size) + 0.4))); level > 0; --level) {
    Pixels half{pixels.width / 2, pixels.height / 2, {}};
    half.rgba.resize(pixels.rgba.size() / 4);
    for (uint32_t y = 0; y < half.height; ++y)
      for (uint32_t x = 0; x < half.width; ++x)
        for (uint32_t c = 0; c < 4; ++c) {
          uint32_t sum = 2;
          for (uint32_t k = 0; k < 4; ++k)
            sum += pixels.rgba[((2 * y + k / 2) * pixels.width + 2 * x + k % 2) * 4 + c];
          half.rgba[(y * half.width + x) * 4 + c] = uint8_t(sum / 4);
        }
    pixels = std::move(half);
  }
  return pixels;
}

class WarpTest : public BothEyes {
 protected:
  static constexpr int kWidth = 160, kHeight = 120;

  // A wall whose uv run at different paces.
  static TestScene wall(const glm::vec2& uvs = {3, 1.7f}) {
    TestScene s;
    s.add(gridMesh({-8, -6, 0}, {16, 0, 0}, {0, 12, 0}, 1, uvs),
          s.material(TestScene::colored("Wall", {0.5f, 0.5f, 0.5f, 1})));
    return s;
  }
  static Look lookOf(double amount, double size, bool contrast = true) {
    return quietLook({{"warp.amount", std::to_string(amount)},
                      {"warp.inflation", "0"},
                      {"warp.metatexture.size", std::to_string(size)},
                      {"warp.metatexture.contrast", contrast ? "gaussian" : "off"},
                      {"warp.metatexture.cyclopean", "off"},
                      {"breakup.metatexture.cyclopean", "off"},
                      {"breakup.metatexture.size", std::to_string(size)},
                      {"breakup.metatexture.contrast", contrast ? "gaussian" : "off"},
                      {"breakup.amount", "1"}});
  }
};
INSTANTIATE_BOTH_EYES(WarpTest);

TEST_P(WarpTest, equalsItsReference) {
  // A tilted wall and a ball.
  TestScene s = wall({9, 4});
  s.add(sphereMesh({0, 0, 1}, 1.5f, 48), 0);
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{4, 2, 6}, {0, 0, 0}}, kWidth, kHeight, GetParam());
  for (const bool contrast : {true, false})
    for (const double size : {300.0, 1800.0}) {
      const Frame frame =
          draw(scene, lookOf(48, size, contrast), views,
               sized(kWidth, kHeight, {"warp", "uv", "uv-gradient", "depth", "id", "metatexture"}));
      const double scale = kHeight / 1080.0;
      MetaTextureReference reference;
      reference.texture.pixels = mipLevel(builtInExample(0), size * scale);
      reference.mean = meanOf(builtInExample(0));
      reference.size = size * scale;
      reference.skew = MetaTextureReference::exact;
      reference.skewLevels = 2;
      reference.contrast = contrast;
      for (size_t v = 0; v < viewCount(); ++v) {
        Difference vectors(0.06), marks(0.06), exponents(0.01), depth(2e-3);
        for (int y = 0; y < kHeight; ++y)
          for (int x = 0; x < kWidth; ++x) {
            const glm::dvec4 got = texel(aov(frame, "warp", v), x, y);
            if (texel(aov(frame, "id", v), x, y).x == 0) {
              EXPECT_EQ(got, glm::dvec4(0.0));
              continue;
            }
            const glm::dvec4 gradients = texel(aov(frame, "uv-gradient", v), x, y);
            glm::dvec2 gradU(gradients.x, gradients.y), gradV(gradients.z, gradients.w);
            const double turn = gradU.x * gradV.y - gradU.y * gradV.x;
            const double skew = std::abs(turn) / glm::length(gradU) / glm::length(gradV);
            if (skew < 0.02) continue;  // seen from the edge
            const auto shown = reference.at({0, 0}, gradU, gradV);
            const glm::dvec4 chosen = texel(aov(frame, "metatexture", v), x, y);
            exponents.add(chosen.x, shown.exponent.x);
            exponents.add(chosen.y, shown.exponent.y);
            exponents.add(chosen.z, shown.q);
            exponents.add(chosen.w, contrast ? 1 / std::sqrt(shown.variance) : 1.0);
            // The pass packs dS/du and dS/dv in 16 bits each.
            const glm::dvec2 dSdu(bfloat(gradV.y / turn), bfloat(-gradV.x / turn)),
                dSdv(bfloat(-gradU.y / turn), bfloat(gradU.x / turn));
            const double det = dSdu.x * dSdv.y - dSdu.y * dSdv.x;
            gradU = glm::dvec2(dSdv.y, -dSdv.x) / det, gradV = glm::dvec2(-dSdu.y, dSdu.x) / det;
            const glm::dvec2 uv(texel(aov(frame, "uv", v), x, y));
            // The ball closes on itself along u.
            const bool isBall = texel(aov(frame, "id", v), x, y).x == 2;
            const glm::dvec4 e = reference.at(uv, gradU, gradV, 1, {isBall, false}).value;
            // The vector is turned along the gradient of u, on the side where u and v turn to the right.
            const glm::dvec2 axis = glm::normalize(gradU) * (turn < 0 ? -1.0 : 1.0),
                             free = (glm::dvec2(e) - glm::dvec2(reference.mean)) * 2.0,
                             w = free * std::min(1.0, 2.0 / glm::length(free));
            const double amount = 48 * scale;
            vectors.add(got.x / amount, axis.x * w.x - axis.y * w.y);
            vectors.add(got.y / amount, axis.y * w.x + axis.x * w.y);
            marks.add(got.z, std::clamp(e.z, 0.0, 1.0));
            depth.add(got.w / texel(aov(frame, "depth", v), x, y).x, 1);
          }
        // Filter weights in steps of 1/256, 8 bit texels and half floats; a packed gradient that is rounded
        // the other way moves a blend by a percent.
        EXPECT_GT(vectors.count, 10000u);
        EXPECT_LT(vectors.beyondPart(), 5e-3) << vectors.text();
        EXPECT_LT(vectors.mean(), 0.01) << vectors.text();
        EXPECT_LT(marks.beyondPart(), 5e-3) << marks.text();
        EXPECT_LT(marks.mean(), 0.01) << marks.text();
        EXPECT_EQ(exponents.beyond, 0u) << exponents.text();
        EXPECT_EQ(depth.beyond, 0u) << depth.text();
      }
    }
}

// FORMULAS 3: on a tilted plane the smooth gradient is the analytic one, and the difference between pixels,
// to a percent.
TEST_P(WarpTest, gradientsOfATiltedPlane) {
  NEEDS_FINE_RASTER();
  const TestScene test = wall();
  const Scene scene = test.load();
  auto views = viewsFrom(scene, {{5, 3, 4}, {0, 0, 0}, 40, 20}, kWidth, kHeight, GetParam());
  for (View& view : views) view.eyeToClip[2][0] = 0.2f, view.eyeToClip[2][1] = -0.1f;
  const Frame frame = draw(scene, quietLook(), views, sized(kWidth, kHeight, {"uv", "uv-gradient", "id"}));
  for (size_t v = 0; v < viewCount(); ++v) {
    const auto uvAt = [&](double x, double y) {  // in pixels from the centre of pixel (0, 0)
      const glm::dmat4 toWorld =
          glm::inverse(glm::dmat4(views[v].eyeToClip) * glm::dmat4(views[v].worldToEye));
      const glm::dvec2 ndc = (glm::dvec2(x, y) + 0.5) / glm::dvec2(kWidth, kHeight) * 2.0 - 1.0;
      const glm::dvec4 a = toWorld * glm::dvec4(ndc, 1, 1), b = toWorld * glm::dvec4(ndc, 0.5, 1);
      const glm::dvec3 p = glm::dvec3(a) / a.w, q = glm::dvec3(b) / b.w;
      const glm::dvec3 hit = p - (q - p) * p.z / (q.z - p.z);
      return glm::dvec2((hit.x + 8) / 16 * 3, (hit.y + 6) / 12 * 1.7);
    };
    size_t count = 0;
    double offAnalytic = 0, offDifference = 0;
    for (int y = 1; y < kHeight - 1; ++y)
      for (int x = 1; x < kWidth - 1; ++x) {
        const Image& id = aov(frame, "id", v);
        bool inside = true;
        for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}})
          inside &= texel(id, x + dx, y + dy).x == 1;
        if (!inside) continue;
        ++count;
        const glm::dvec4 g = texel(aov(frame, "uv-gradient", v), x, y);
        const double h = 1e-3;
        const glm::dvec2 dx = (uvAt(x + h, y) - uvAt(x - h, y)) / (2 * h),
                         dy = (uvAt(x, y + h) - uvAt(x, y - h)) / (2 * h);
        const glm::dvec4 analytic(dx.x, dy.x, dx.y, dy.y);
        const Image& uv = aov(frame, "uv", v);
        const glm::dvec4 ex = 0.5 * (texel(uv, x + 1, y) - texel(uv, x - 1, y)),
                         ey = 0.5 * (texel(uv, x, y + 1) - texel(uv, x, y - 1));
        const glm::dvec4 difference(ex.x, ey.x, ex.y, ey.y);
        const auto off = [&](const glm::dvec4& e) {
          const double u = glm::length(glm::dvec2(g) - glm::dvec2(e)) / glm::length(glm::dvec2(e));
          const double w =
              glm::length(glm::dvec2(g.z, g.w) - glm::dvec2(e.z, e.w)) / glm::length(glm::dvec2(e.z, e.w));
          return std::max(u, w);
        };
        offAnalytic = std::max(offAnalytic, off(analytic));
        offDifference = std::max(offDifference, off(difference));
      }
    EXPECT_GT(count, 8000u);
    EXPECT_LT(offAnalytic, 0.002);
    EXPECT_LT(offDifference, 0.01);
  }
}

// FORMULAS 1: as the size goes through two octaves the colour never jumps; least of all where an exponent is
// whole, because the blend stands still there.
TEST_F(WarpTest, continuousWhereExponentsAreWhole) {
  const Scene scene = wall({5, 2.2f}).load();
  const View view = parallelView(2, 4.0f / 3);
  constexpr int kSteps = 33;
  const double step = 1.0 / 16;  // octaves
  std::vector<Image> warps;
  std::vector<glm::dvec2> exponents;
  for (int i = 0; i <= kSteps; ++i) {
    const double size = std::exp2(step * (90 + i)) * 1080 / kHeight;
    const Frame frame =
        draw(scene, lookOf(64, size), {view}, sized(kWidth, kHeight, {"warp", "metatexture"}));
    warps.push_back(aov(frame, "warp"));
    exponents.push_back(glm::dvec2(texel(aov(frame, "metatexture"), 80, 60)));
  }
  double across = 0, elsewhere = 0;
  int crossings = 0, others = 0;
  for (int i = 0; i < kSteps; ++i) {
    double sum = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const glm::dvec4 d = texel(warps[size_t(i)], x, y) - texel(warps[size_t(i) + 1], x, y);
        sum += d.x * d.x + d.y * d.y;
      }
    const double rms = std::sqrt(sum / (kWidth * kHeight)) / (64.0 * kHeight / 1080);
    const glm::dvec2 a = exponents[size_t(i)], b = exponents[size_t(i) + 1];
    const bool crosses = glm::floor(a) != glm::floor(b);
    (crosses ? across : elsewhere) = std::max(crosses ? across : elsewhere, rms);
    ++(crosses ? crossings : others);
  }
  EXPECT_GE(crossings, 4);
  EXPECT_GE(others, 20);
  // A blend moves by at most 1.5 of its way an octave; copies differ by about one standard deviation (0.5)
  // times sqrt 2, and contrast may double that.
  EXPECT_LT(elsewhere, 1.5 * step * 0.5 * 1.42 * 2 * 1.42);
  EXPECT_LT(across, 0.7 * elsewhere);
  RecordProperty("across_permille", int(1000 * across));
  RecordProperty("elsewhere_permille", int(1000 * elsewhere));
}

// FORMULAS 2: the same contrast at every zoom.
TEST_F(WarpTest, contrastIsSteadyOverAZoom) {
  const Scene scene = wall({8, 6}).load();  // square in metres
  double least[2] = {1e9, 1e9}, most[2] = {0, 0};
  for (const bool contrast : {false, true})
    for (int i = 0; i < 12; ++i) {
      const View view = parallelView(2.0f * std::exp2(float(i) / 8), 4.0f / 3);
      const Frame frame = draw(scene, lookOf(64, 216, contrast), {view}, sized(320, 240, {"warp"}));
      glm::dvec2 sum(0.0), squares(0.0);
      for (int y = 0; y < 240; ++y)
        for (int x = 0; x < 320; ++x) {
          const glm::dvec2 w(texel(aov(frame, "warp"), x, y));
          sum += w, squares += w * w;
        }
      const double n = 320 * 240, pixels = 64.0 * 240 / 1080;
      const glm::dvec2 variance = squares / n - sum * sum / n / n;
      const double deviation = std::sqrt(0.5 * (variance.x + variance.y)) / pixels;
      least[contrast] = std::min(least[contrast], deviation),
      most[contrast] = std::max(most[contrast], deviation);
    }
  EXPECT_LT(most[1] / least[1], 1.12) << least[1] << " to " << most[1];
  EXPECT_GT(most[0] / least[0], 1.5) << "blending alone takes half of it away";
  RecordProperty("ratio_percent", int(100 * most[1] / least[1]));
}

// FORMULAS 9: a roll of the camera by 90 degrees rolls the picture and the vectors with it.
TEST_P(WarpTest, cameraRollRollsThePicture) {
  constexpr int kSize = 128;
  const Scene scene = stillLife().load();
  // The sky's gradient and the light are of the world, so they roll as well.
  const Look look = quietLook({{"warp.amount", "40"}, {"warp.inflation", "20"}, {"light.shadowWarp", "0"}});
  const auto render = [&](float roll) {
    Stand stand{{2, 2.5f, 6}, {0, 0.8f, 0}, 40, roll, 0};  // both eyes at one place: ipd turns with the head
    return draw(scene, look, viewsFrom(scene, stand, kSize, kSize, GetParam()),
                sized(kSize, kSize, {"warp", "color"}));
  };
  const Frame upright = render(0), rolled = render(90);
  for (size_t v = 0; v < viewCount(); ++v) {
    Difference picture(0.02), vectors(0.25);
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        // Right is up in the rolled picture.
        const glm::dvec4 a = texel(aov(upright, "", v), x, y),
                         b = texel(aov(rolled, "", v), y, kSize - 1 - x);
        for (int c = 0; c < 3; ++c) picture.add(a[c], b[c]);
        const glm::dvec4 p = texel(aov(upright, "warp", v), x, y),
                         q = texel(aov(rolled, "warp", v), y, kSize - 1 - x);
        vectors.add(p.x, -q.y);
        vectors.add(p.y, q.x);
      }
    EXPECT_LT(picture.beyondPart(), 0.04) << picture.text();
    EXPECT_LT(picture.mean(), 3e-3) << picture.text();
    EXPECT_LT(vectors.beyondPart(), 0.02) << vectors.text();
  }
}

// Inflation widens the covered part by as many pixels as it says, and nothing where it is 0.
TEST_P(WarpTest, inflationWidensTheSilhouette) {
  TestScene s;
  s.add(sphereMesh({0, 0, 0}, 1, 64), s.material(TestScene::colored("Ball", {0.5f, 0.5f, 0.5f, 1})));
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 6}}, kWidth, kHeight, GetParam());
  for (const double pixels : {0.0, 3.0, 6.0}) {
    const Frame frame = draw(scene, quietLook({{"warp.inflation", std::to_string(pixels * 1080 / kHeight)}}),
                             views, sized(kWidth, kHeight, {"warp", "id"}));
    for (size_t v = 0; v < viewCount(); ++v) {
      double area = 0, inflated = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          area += texel(aov(frame, "id", v), x, y).x;
          inflated += texel(aov(frame, "warp", v), x, y).w > 0;
        }
      EXPECT_NEAR(std::sqrt(inflated / 3.14159265) - std::sqrt(area / 3.14159265), pixels, 0.4);
    }
  }
}

// What warp.amount promises: 0.6 of it on the average, and nowhere more than twice as much, however copies
// are blended and contrast is restored.
TEST_P(WarpTest, nothingIsTornFartherThanTwice) {
  const Scene scene = wall().load();
  constexpr double kAmount = 48;
  double longest = 0;
  for (const char* base : {"2", "1.1"})
    for (const char* skew : {"off", "exact"}) {
      double sum = 0, count = 0;
      for (const float away : {2.0f, 2.7f, 3.6f}) {
        Look look = lookOf(kAmount, 960);  // an example's texel is a pixel
        EXPECT_TRUE(look.set("warp.metatexture.base", base).ok());
        EXPECT_TRUE(look.set("warp.metatexture.skew", skew).ok());
        const Frame frame =
            draw(scene, look, viewsFrom(scene, {{0.3f, 0.2f, away}}, 4 * kWidth, 4 * kHeight, GetParam()),
                 sized(4 * kWidth, 4 * kHeight, {"warp"}));
        for (size_t v = 0; v < viewCount(); ++v)
          for (int y = 0; y < 4 * kHeight; ++y)
            for (int x = 0; x < 4 * kWidth; ++x) {
              const glm::dvec4 got = texel(aov(frame, "warp", v), x, y);
              if (got.w == 0) continue;
              const double length = glm::length(glm::dvec2(got)) / (kAmount * 4 * kHeight / 1080);
              longest = std::max(longest, length), sum += length, ++count;
            }
      }
      ASSERT_GT(count, 10000);
      EXPECT_NEAR(sum / count, 0.6, 0.1) << "base " << base << ", skew " << skew;
    }
  EXPECT_LE(longest, 2.002);  // half floats
  EXPECT_GT(longest, 1.5);
}

// Eq. 26: the amount falls with distance.
TEST_F(WarpTest, farThingsAreTornLess) {
  const Scene scene = wall().load();
  const auto spread = [&](float away, const char* distance, const char* least = "0") {
    Look look = lookOf(64, 256);
    EXPECT_TRUE(look.set("warp.distance", distance).ok());
    EXPECT_TRUE(look.set("warp.least", least).ok());
    const Frame frame = draw(scene, look, viewsFrom(scene, {{0, 0, away}, {0, 0, 0}, 20}, kWidth, kHeight),
                             sized(kWidth, kHeight, {"warp"}));
    double most = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        most = std::max(most, glm::length(glm::dvec2(texel(aov(frame, "warp"), x, y))));
    return most;
  };
  EXPECT_NEAR(spread(10, "0.2") / spread(10, "0"), 1 / (1 + 4.0), 0.02);
  EXPECT_NEAR(spread(5, "0.2") / spread(5, "0"), 1 / (1 + 1.0), 0.02);
  // But never by less than they are to be torn at least, or by more than without.
  EXPECT_NEAR(spread(10, "10", "16") / spread(10, "0"), 0.25, 0.02);
  EXPECT_NEAR(spread(10, "0.2", "4") / spread(10, "0"), 1 / (1 + 4.0), 0.02);
  EXPECT_EQ(spread(10, "10", "64"), spread(10, "0", "0"));
}

// FORMULAS 3 for the other choice: differences between pixels choose the same scales on a plane, to a
// percent; on a coarse ball they are flat in each triangle where the smooth ones are not.
TEST_P(WarpTest, fragmentGradientsAgreeOnAPlane) {
  NEEDS_FINE_RASTER();
  constexpr int width = 2 * kWidth, height = 2 * kHeight;  // differences are over pixels of some size
  const Scene scene = wall({5, 2}).load();
  const auto views = viewsFrom(scene, {{5, 3, 4}, {0, 0, 0}, 40, 20}, width, height, GetParam());
  for (const char* cyclopean : {"off", "on"}) {
    const auto drawn = [&](const char* gradients) {
      return draw(
          scene,
          quietLook({{"warp.metatexture.gradients", gradients}, {"warp.metatexture.cyclopean", cyclopean}}),
          views, sized(width, height, {"metatexture", "id"}));
    };
    const Frame smooth = drawn("smooth"), fragment = drawn("fragment");
    for (size_t v = 0; v < viewCount(); ++v) {
      // A percent of a gradient is 0.0144 of an exponent.
      Difference exponents(0.0144);
      for (int y = 2; y < height - 2; ++y)
        for (int x = 2; x < width - 2; ++x) {
          bool inside = true;
          for (int i = 0; i < 9; ++i)
            inside &= texel(aov(smooth, "id", v), x - 1 + i % 3, y - 1 + i / 3).x == 1;
          if (!inside) continue;
          const glm::dvec4 a = texel(aov(smooth, "metatexture", v), x, y),
                           b = texel(aov(fragment, "metatexture", v), x, y);
          exponents.add(a.x, b.x), exponents.add(a.y, b.y);
        }
      EXPECT_GT(exponents.count, 10000u);
      EXPECT_LT(exponents.beyondPart(), 0.01) << exponents.text() << ", cyclopean " << cyclopean;
    }
  }
}

// FORMULAS 4: for an off-centre projection alpha is 1 + tan^2 of the angle between the pixel's ray and the
// view axis.
TEST_P(WarpTest, radialAngle) {
  const Scene scene = wall({5, 2}).load();
  auto views = viewsFrom(scene, {{1, 0.5f, 5}, {0, 0, 0}, 70}, kWidth, kHeight, GetParam());
  for (View& view : views) view.eyeToClip[2][0] = 0.3f, view.eyeToClip[2][1] = -0.2f;
  const auto drawn = [&](const char* radial) {
    return draw(scene,
                quietLook({{"warp.metatexture.radial", radial},
                           {"warp.metatexture.skew", "off"},
                           {"warp.metatexture.cyclopean", "off"}}),
                views, sized(kWidth, kHeight, {"metatexture", "position", "id"}));
  };
  const Frame off = drawn("off"), on = drawn("on");
  for (size_t v = 0; v < viewCount(); ++v) {
    Difference alphas(2e-3);
    double most = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        if (texel(aov(off, "id", v), x, y).x == 0) continue;
        const glm::dvec4 eye =
            glm::dmat4(views[v].worldToEye) * glm::dvec4(glm::dvec3(texel(aov(off, "position", v), x, y)), 1);
        const double tangent = glm::length(glm::dvec2(eye)) / -eye.z;
        const double alpha =
            std::exp2(texel(aov(off, "metatexture", v), x, y).x - texel(aov(on, "metatexture", v), x, y).x);
        alphas.add(alpha, 1 + tangent * tangent);
        most = std::max(most, alpha);
      }
    EXPECT_EQ(alphas.beyond, 0u) << alphas.text();
    EXPECT_GT(most, 1.5);
  }
}

// (Paper 000, section 3.3.) What is left to itself compensates in wide views and not in narrow ones, and goes
// from the one to the other without a jump; parallel projections have no angle.
TEST_P(WarpTest, radialAngleFollowsTheView) {
  const Scene scene = wall({30, 20}).load();
  const auto drawn = [&](const char* radial, float across, bool isParallel) {
    const float fov = float(glm::degrees(2 * std::atan(across * kHeight / kWidth)));
    auto views = viewsFrom(scene, {{1, 0.5f, 5}, {1, 0.5f, 0}, fov, 0, 0.02f}, kWidth, kHeight, GetParam());
    if (isParallel)
      for (View& view : views) view = parallelView(4, float(kWidth) / kHeight);
    return draw(scene, quietLook({{"warp.metatexture.radial", radial}, {"warp.metatexture.skew", "off"}}),
                views, sized(kWidth, kHeight, {"metatexture", "warp"}));
  };
  // Exponent along u in a corner.
  const auto exponent = [&](const char* radial, float across, size_t v) {
    return texel(aov(drawn(radial, across, false), "metatexture", v), 2, 2).x;
  };
  const auto expectSameBytes = [&](float across, const char* as, bool isParallel) {
    const Frame left = drawn("auto", across, isParallel), right = drawn(as, across, isParallel);
    for (size_t v = 0; v < viewCount(); ++v)
      EXPECT_TRUE(sameBytes(aov(left, "warp", v), aov(right, "warp", v))) << across << " as " << as;
  };
  expectSameBytes(0.4f, "off", false);
  expectSameBytes(0.68f, "off", false);
  expectSameBytes(1.02f, "on", false);
  expectSameBytes(2, "on", false);
  expectSameBytes(1, "off", true);
  for (size_t v = 0; v < viewCount(); ++v) {
    double before = 0;
    for (float across = 0.7f; across < 1.01f; across += 0.05f) {
      const double off = exponent("off", across, v), on = exponent("on", across, v),
                   part = (off - exponent("auto", across, v)) / (off - on);
      EXPECT_GE(part, before - 0.02) << across;
      EXPECT_LT(part, before + 0.4) << across;
      before = part;
    }
    EXPECT_GT(before, 0.98);
  }
}

// FORMULAS 7: the exponents chosen at one surface point are the same in both eyes; and so are the vectors.
TEST_F(WarpTest, bothEyesChooseTheSame) {
  TestScene s = wall({9, 4});
  s.add(sphereMesh({0.5f, 0, 1}, 1.5f, 48), 0);
  const Scene scene = s.load();
  auto views = viewsFrom(scene, {{4, 1, 3}, {0, 0, 0}, 50, 0, 0.6f}, 320, 240, Stereo::stereo);
  // As headsets have it: each eye's frustum leans outwards.
  views[0].eyeToClip[2][0] = -0.1f, views[1].eyeToClip[2][0] = 0.1f;
  double mean[2] = {};
  for (const bool cyclopean : {false, true}) {
    Look look = lookOf(48, 900);
    ASSERT_TRUE(look.set("warp.metatexture.cyclopean", cyclopean ? "on" : "off").ok());
    const Frame frame = draw(scene, look, views, sized(320, 240, {"metatexture", "position", "id", "warp"}));
    Difference exponents(0.02), vectors(0.3);
    for (int y = 0; y < 240; ++y)
      for (int x = 0; x < 320; ++x) {
        const double id = texel(aov(frame, "id", 0), x, y).x;
        if (id == 0) continue;
        const glm::dvec3 p(texel(aov(frame, "position", 0), x, y));
        const glm::dvec4 clip =
            glm::dmat4(views[1].eyeToClip) * glm::dmat4(views[1].worldToEye) * glm::dvec4(p, 1);
        const glm::dvec2 at = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(320, 240);
        const int i = int(std::floor(at.x)), j = int(std::floor(at.y));
        if (i < 0 || j < 0 || i >= 320 || j >= 240 || texel(aov(frame, "id", 1), i, j).x != id) continue;
        // The same point, within a pixel.
        const glm::dvec3 q(texel(aov(frame, "position", 1), i, j));
        if (glm::length(q - p) > 0.012) continue;
        for (int c = 0; c < 3; ++c)
          exponents.add(texel(aov(frame, "metatexture", 0), x, y)[c],
                        texel(aov(frame, "metatexture", 1), i, j)[c]);
        for (int c = 0; c < 2; ++c)
          vectors.add(texel(aov(frame, "warp", 0), x, y)[c] / 10.7,
                      texel(aov(frame, "warp", 1), i, j)[c] / 10.7);
      }
    EXPECT_GT(exponents.count, 10000u);
    mean[cyclopean] = exponents.mean();
    if (cyclopean) {
      EXPECT_LT(exponents.mean(), 0.01) << exponents.text();
      EXPECT_LT(vectors.mean(), 0.12) << vectors.text();
    }
  }
  EXPECT_GT(mean[0], 5 * mean[1]) << "by themselves they differ";
}

// A mapping that is mirrored along u: the vectors go on across the seam.
TEST_P(WarpTest, mirroredMappingsHaveNoSeam) {
  TestScene s;
  const int material = s.material(TestScene::colored("Wall", {0.5f, 0.5f, 0.5f, 1}));
  s.add(gridMesh({0, -3, 0}, {4, 0, 0}, {0, 6, 0}, 1, {2, 3}), material);
  // The left half: u grows to the left.
  TestMesh left = gridMesh({-4, -3, 0}, {4, 0, 0}, {0, 6, 0}, 1, {2, 3});
  for (glm::vec2& uv : left.uvs) uv.x = 2 - uv.x;
  s.add(left, material);
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 6}}, kWidth, kHeight, GetParam());
  const Frame frame = draw(scene, lookOf(64, 2000), views, sized(kWidth, kHeight, {"warp", "id"}));
  for (size_t v = 0; v < viewCount(); ++v) {
    double across = 0, along = 0;
    int count = 0;
    for (int y = 10; y < kHeight - 10; ++y)
      for (int x = 1; x < kWidth; ++x) {
        const Image &id = aov(frame, "id", v), &warp = aov(frame, "warp", v);
        if (texel(id, x, y).x != 1 || texel(id, x - 1, y).x != 2) continue;
        across += glm::length(glm::dvec2(texel(warp, x, y) - texel(warp, x - 1, y)));
        along += glm::length(glm::dvec2(texel(warp, x + 3, y) - texel(warp, x + 2, y)));
        ++count;
      }
    EXPECT_GT(count, 60);
    EXPECT_LT(across, 1.5 * along) << "as steady as elsewhere";
  }
}

// Seams of split vertices do not open: a box with hard edges is covered without a hole, however far it is
// inflated.
TEST_P(WarpTest, hardEdgesStayClosed) {
  TestScene s;
  s.add(boxMesh({-1, -1, -1}, {1, 1, 1}), s.material(TestScene::colored("Box", {0.5f, 0.5f, 0.5f, 1})));
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{3, 2.5f, 4}}, kWidth, kHeight, GetParam());
  const Frame frame =
      draw(scene, quietLook({{"warp.inflation", "60"}}), views, sized(kWidth, kHeight, {"warp", "id"}));
  for (size_t v = 0; v < viewCount(); ++v) {
    size_t box = 0, holes = 0;
    for (int y = 0; y < kHeight; ++y) {
      int first = kWidth, last = -1;
      for (int x = 0; x < kWidth; ++x)
        if (texel(aov(frame, "warp", v), x, y).w > 0) first = std::min(first, x), last = x;
      for (int x = first; x <= last; ++x) holes += texel(aov(frame, "warp", v), x, y).w == 0;
      for (int x = 0; x < kWidth; ++x) {
        const bool covered = texel(aov(frame, "warp", v), x, y).w > 0;
        box += texel(aov(frame, "id", v), x, y).x == 1;
        holes += texel(aov(frame, "id", v), x, y).x == 1 && !covered;
      }
    }
    EXPECT_GT(box, 1000u);
    EXPECT_EQ(holes, 0u);
  }
}

// Percent of the image's height is the other unit of inflation.
TEST_F(WarpTest, inflationInPercent) {
  WarpParams params;
  params.inflation = 2;
  params.inflationUnit = 1;
  EXPECT_FLOAT_EQ(inflationPixels(params, 720), 14.4f);
  params.inflationUnit = 0;
  EXPECT_FLOAT_EQ(inflationPixels(params, 540), 1.0f);
}

// The attribute _WARP scales amount and inflation vertex by vertex: faces stay clear.
TEST_P(WarpTest, verticesScaleTheAmount) {
  TestScene s;
  TestMesh mesh = gridMesh({-2, -1.5f, 0}, {4, 0, 0}, {0, 3, 0}, 16, {3, 2});
  for (const glm::vec3& p : mesh.positions) mesh.warpScales.push_back(p.x < 0.01f ? 0.0f : 1.0f);
  s.add(mesh, s.material(TestScene::colored("Wall", {0.5f, 0.5f, 0.5f, 1})));
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 5}}, kWidth, kHeight, GetParam());
  const Frame frame = draw(scene, lookOf(64, 500), views, sized(kWidth, kHeight, {"warp", "position", "id"}));
  for (size_t v = 0; v < viewCount(); ++v) {
    double left = 0, right = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        if (texel(aov(frame, "id", v), x, y).x == 0) continue;
        const double length = glm::length(glm::dvec2(texel(aov(frame, "warp", v), x, y)));
        const double at = texel(aov(frame, "position", v), x, y).x;
        if (at < -0.05) left = std::max(left, length);
        if (at > 0.3) right = std::max(right, length);
      }
    EXPECT_EQ(left, 0);
    EXPECT_GT(right, 3);
  }
}

// FORMULAS 11: drawings change on the grid of 24 frames a second only, and come back after their number.
TEST_P(WarpTest, lineBoilOnTwos) {
  const Scene scene = wall().load();
  const auto views = viewsFrom(scene, {{0, 0, 5}}, kWidth, kHeight, GetParam());
  const auto drawnAt = [&](double time, const char* boil) {
    Look look = lookOf(64, 500);
    EXPECT_TRUE(look.set("warp.boil", boil).ok() && look.set("warp.boilDrawings", "3").ok());
    Result<Frame> frame = renderer().render(scene, look, time, views, sized(kWidth, kHeight, {"warp"}));
    EXPECT_TRUE(frame.ok());
    return aov(*frame, "warp", viewCount() - 1);
  };
  const Image first = drawnAt(0, "1");
  EXPECT_TRUE(sameBytes(first, drawnAt(0, "0"))) << "a still is what it is without boil";
  EXPECT_TRUE(sameBytes(first, drawnAt(1.0 / 90, "1"))) << "the display's rate does not matter";
  EXPECT_TRUE(sameBytes(first, drawnAt(1.0 / 24, "1"))) << "on twos";
  EXPECT_FALSE(sameBytes(first, drawnAt(2.0 / 24, "1")));
  EXPECT_TRUE(sameBytes(drawnAt(2.0 / 24, "1"), drawnAt(3.0 / 24 + 0.01, "1")));
  EXPECT_FALSE(sameBytes(drawnAt(2.0 / 24, "1"), drawnAt(4.0 / 24, "1")));
  EXPECT_TRUE(sameBytes(first, drawnAt(6.0 / 24, "1"))) << "three drawings, then again";
  EXPECT_TRUE(sameBytes(first, drawnAt(2.0 / 24, "0")));
  // Every frame of a long film falls into its own drawing.
  for (const int hold : {1, 2, 3, 4})
    for (int frame = 0; frame < 30000; ++frame)
      ASSERT_EQ(boilDrawing(4, hold, frame / 24.0), frame / hold % 4) << frame << ", held for " << hold;
  EXPECT_EQ(boilDrawing(4, 2, -2.0 / 24), 3);
  EXPECT_EQ(boilDrawing(4, 0, 5.0 / 24), boilDrawing(4, 1, 5.0 / 24));
}

// Materials with textures and knobs of their own are each evaluated with them: as if they were alone.
TEST_P(WarpTest, everyMaterialHasItsOwnSetup) {
  TestScene s;
  const int a = s.material(TestScene::colored("A", {0.5f, 0.5f, 0.5f, 1})),
            b = s.material(TestScene::colored("B", {0.5f, 0.5f, 0.5f, 1})),
            c = s.material(TestScene::colored("C", {0.5f, 0.5f, 0.5f, 1}));
  s.add(gridMesh({-3, -2, 0}, {2, 0, 0}, {0, 4, 0}), a);
  s.add(gridMesh({-1, -2, 0}, {2, 0, 0}, {0, 4, 0}), b);
  s.add(gridMesh({1, -2, 0}, {2, 0, 0}, {0, 4, 0}), c);
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 6}}, kWidth, kHeight, GetParam());
  const std::vector<std::pair<std::string, std::string>> knobs[] = {
      {{"warp.metatexture.size", "700"}, {"breakup.metatexture.example", "strokes"}},
      {{"warp.metatexture.base", "3"}, {"warp.metatexture.levelRotation", "40"}},
      {{"warp.metatexture.mode", "screen"}, {"breakup.metatexture.size", "90"}}};
  std::vector<std::pair<std::string, std::string>> all{{"warp.inflation", "0"}};
  for (int m = 0; m < 3; ++m)
    for (const auto& [path, value] : knobs[m])
      all.push_back({std::string("materials.") + "ABC"[m] + "." + path, value});
  const RenderOptions options = sized(kWidth, kHeight, {"warp", "id"});
  const Frame together = draw(scene, quietLook(all), views, options);
  for (int m = 0; m < 3; ++m) {
    std::vector<std::pair<std::string, std::string>> alone{{"warp.inflation", "0"}};
    alone.insert(alone.end(), knobs[m].begin(), knobs[m].end());
    const Frame single = draw(scene, quietLook(alone), views, options);
    for (size_t v = 0; v < viewCount(); ++v) {
      size_t count = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          if (texel(aov(together, "id", v), x, y).x != m + 1) continue;
          EXPECT_EQ(texel(aov(together, "warp", v), x, y), texel(aov(single, "warp", v), x, y));
          ++count;
        }
      EXPECT_GT(count, 1000u);
    }
  }
}

}  // namespace
}  // namespace scumble::passes
