// The sea as it is drawn and painted against the same in double precision: its waves from docs/ocean.md, its
// paint from paper 000, section 6.1. Pictures stand for the maps, of which red says how far across a colour
// was taken, and green how far down.
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/stroke_maps.h"
#include "base/test_folder.h"
#include "features/ocean/paint/ocean_knobs.h"
#include "features/ocean/sea_reference.h"
#include "features/ocean/waves/maps.h"
#include "scumble/image.h"
#include "tests/support/aov.h"
#include "tests/support/metatexture_reference.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"
#include "tests/support/sanitized.h"
#include "tests/support/test_device.h"

namespace scumble::ocean {
namespace {

using namespace test;

constexpr int kPaintWidth = 64, kPaintHeight = 48, kRampSide = 64;
constexpr double kRamp = 1.0 / kRampSide;
// Targets hold square roots in 8 bits, and so do the pictures, nearly.
constexpr double kPaintByte = 2.5 / 255;
constexpr double kStrokesSize = 4096;  // pixels at 1080 lines: as fine as the pattern is

double roundedBfloat(double value) {
  return std::bit_cast<float>((std::bit_cast<uint32_t>(float(value)) + 0x8000u) & 0xFFFF0000u);
}

// Where between the middles of the first and the last texel a picture is sampled.
double inRamp(double at) {
  return std::clamp(at, 0.5 * kRamp, 1 - 0.5 * kRamp);
}

class OceanPaintTest : public BothEyes {
 protected:
  // Water at a pixel, by the reference.
  struct Water {
    glm::dvec3 at, normal;
    double height = 0, jacobian = 1;  // metres
  };

  // Square roots of colours: red is how far across, green how far down, blue all the same; alpha.
  std::string ramp(const std::string& name, double blue, double alpha) const {
    Image image{kRampSide, kRampSide, {"R", "G", "B", "A"}, {}};
    for (int y = 0; y < kRampSide; ++y)
      for (int x = 0; x < kRampSide; ++x) {
        const double u = (x + 0.5) * kRamp, v = (y + 0.5) * kRamp;
        for (const double value : {u * u, v * v, blue * blue, alpha}) image.pixels.push_back(float(value));
      }
    std::string path = folder_.file(name + ".png");
    EXPECT_TRUE(writePng(path, image).ok());
    return path;
  }

  // A sea with nothing on it but what knobs add; the sun stands over +x and a little of -z.
  static Scene openWater() {
    TestScene s;
    s.add(boxMesh({-0.1f, -9, -0.1f}, {0.1f, -8.9f, 0.1f}),
          s.material(TestScene::colored("Wood", {0.5f, 0.4f, 0.3f, 1})));
    s.light(glm::vec3(kToSun));
    return s.load();
  }
  Frame paint(const Scene& scene, const Knobs& knobs, double time, const std::vector<View>& views) const {
    Knobs all{{"ocean.mode", "on"},
              {"ocean.tiles", "3"},
              {"ocean.paint.colors", ramp("water", 0, 1)},
              {"ocean.paint.reflection", "0"},
              {"ocean.paint.foam", "0"},
              {"ocean.paint.dither", "0"},
              {"ocean.paint.lightDither", "0"},
              {"ocean.paint.lightWaves", "0"},
              {"ocean.paint.skyDither", "0"},
              {"ocean.paint.follow", "off"},
              {"ocean.metatexture.contrast", "gaussian"},
              {"ocean.metatexture.cyclopean", "off"},
              {"ocean.metatexture.size", std::to_string(kStrokesSize)}};
    all.insert(all.end(), knobs.begin(), knobs.end());
    Result<Frame> frame =
        renderer().render(scene, quietLook(all), time, views,
                          sized(kPaintWidth, kPaintHeight,
                                {"position", "normal", "id", "uv", "uv-gradient", "lit", "shadowed"}));
    if (!frame) throw std::runtime_error(frame.error().message());
    return std::move(frame).value();
  }
  static Knobs knobsOf(const SeaState& s) {
    return {{"ocean.grid", std::to_string(s.grid)},
            {"ocean.tile", std::to_string(s.tile)},
            {"ocean.wind", std::to_string(s.wind)},
            {"ocean.windDirection", std::to_string(s.windDirection)},
            {"ocean.fetch", std::to_string(s.fetch)},
            {"ocean.smallest", std::to_string(s.smallest)},
            {"ocean.choppiness", std::to_string(s.choppiness)},
            {"ocean.height", std::to_string(s.height)},
            {"ocean.loop", std::to_string(s.loop)},
            {"ocean.seed", std::to_string(s.seed)}};
  }
  static bool isWater(const Frame& frame, size_t view, int x, int y) {
    return texel(aov(frame, "id", view), x, y).x == 4;  // after two nodes and the ground
  }

  // What of the reference's mesh a pixel sees, where the drawn one has all points and whole waves.
  static std::optional<Water> waterAt(const SeaReference::Mesh& mesh, const View& view, int x, int y) {
    const std::optional<Hit> hit = castRay(pixelRay(view, x, y, kPaintWidth, kPaintHeight), mesh.triangles);
    if (!hit || std::max(std::abs(hit->position.x), std::abs(hit->position.z)) > 8) return {};
    Water water{hit->position, hit->normal, 0, 0};
    for (int i = 0; i < 3; ++i) {
      const SeaReference::Corner& corner = mesh.corners[3 * hit->triangle + size_t(i)];
      water.height += hit->barycentric[i] * corner.height;
      water.jacobian += hit->barycentric[i] * corner.jacobian;
    }
    return water;
  }

  // What both eyes look from.
  static glm::dvec3 eyeOf(const std::vector<View>& views) {
    glm::dvec3 sum(0.0);
    for (const View& view : views) sum += glm::dvec3(glm::inverse(glm::dmat4(view.worldToEye))[3]);
    return sum / double(views.size());
  }
  // Crests that are seen edge-on show nothing.
  static double facing(const glm::dvec3& normal, const glm::dvec3& toEye) {
    return smoothstep(0.1, 0.6, std::abs(glm::dot(normal, toEye)) / std::abs(toEye.y));
  }

  // MetaTexture of a pattern at a pixel. The pass packs dS/du and dS/dv in 16 bits each.
  static glm::dvec4 patternAt(const Pixels& pattern, const Frame& frame, size_t view, int x, int y) {
    static const glm::dvec4 kMean = meanOf(seaStrokes());
    MetaTextureReference reference;
    reference.texture.pixels = pattern;
    reference.mean = kMean;
    reference.size = kStrokesSize * kPaintHeight / 1080;
    const glm::dvec4 g = texel(aov(frame, "uv-gradient", view), x, y);
    const double turn = g.x * g.w - g.y * g.z;
    const glm::dvec2 dSdu(roundedBfloat(g.w / turn), roundedBfloat(-g.z / turn)),
        dSdv(roundedBfloat(-g.y / turn), roundedBfloat(g.x / turn));
    const double det = dSdu.x * dSdv.y - dSdu.y * dSdv.x;
    return reference
        .at(glm::dvec2(texel(aov(frame, "uv", view), x, y)), glm::dvec2(dSdv.y, -dSdv.x) / det,
            glm::dvec2(-dSdu.y, dSdu.x) / det)
        .value;
  }

  static inline const glm::dvec3 kToSun = glm::normalize(glm::dvec3(1, 0.6, -0.4));

 private:
  TestFolder folder_;
};
INSTANTIATE_BOTH_EYES(OceanPaintTest);

const Stand kOverTheSea{{7, 6, 8}, {0, 0, 0}, 50};

// ---- Waves ----

// Docs/ocean.md by sums and differences: where the water is, its normals, and which column of the bathic map
// its height takes.
TEST_P(OceanPaintTest, wavesNormalsAndColumns) {
  NEEDS_FINE_RASTER();
  const Scene scene = openWater();
  const auto views = viewsFrom(scene, kOverTheSea, kPaintWidth, kPaintHeight, GetParam());
  struct Case {
    double direction, choppiness, speed, time;
    uint32_t seed;
  };
  for (const Case& c : {Case{40, 1.2, 0, 2.7, 1}, {-160, 0.7, 1.9, -3.3, 5}, {95, 0, -0.8, 1.1, 9}}) {
    SeaState state;
    state.windDirection = c.direction, state.choppiness = c.choppiness, state.seed = c.seed;
    const SeaReference sea(state, c.time);
    const double heading = glm::radians(25.0);
    const SeaReference::Mesh mesh =
        sea.mesh(9, c.speed * c.time * glm::dvec2(std::cos(heading), std::sin(heading)));
    Knobs knobs = knobsOf(state);
    knobs.insert(knobs.end(), {{"ocean.speed", std::to_string(c.speed)}, {"ocean.heading", "25"}});
    const Frame frame = paint(scene, knobs, c.time, views);
    for (size_t v = 0; v < viewCount(); ++v) {
      // Of waves of a metre: short ones' shares of the spectrum are integrated from a few points there.
      Difference places(3e-3), normals(1.5e-3), columns(kPaintByte);
      for (int y = 0; y < kPaintHeight; ++y)
        for (int x = 0; x < kPaintWidth; ++x) {
          const std::optional<Water> water = waterAt(mesh, views[v], x, y);
          if (!water || !isWater(frame, v, x, y)) continue;
          for (int i = 0; i < 3; ++i) {
            places.add(texel(aov(frame, "position", v), x, y)[i], water->at[i]);
            normals.add(texel(aov(frame, "normal", v), x, y)[i], water->normal[i]);
          }
          // Calm water has few colours: a tenth of a metre counts as waves.
          const double relief = std::hypot(sea.deviation(), 0.1);
          columns.add(std::sqrt(texel(aov(frame, "lit", v), x, y).x),
                      inRamp(0.42 + 0.14 * std::clamp(water->height / relief, -2.0, 2.0)));
        }
      EXPECT_GT(columns.count, 1500u) << c.direction;
      // At crests that hide others a pixel's middle may lie on either.
      EXPECT_LT(places.beyondPart(), 4e-3) << c.direction << ": " << places.text();
      EXPECT_LT(normals.beyondPart(), 4e-3) << c.direction << ": " << normals.text();
      EXPECT_LT(columns.beyondPart(), 4e-3) << c.direction << ": " << columns.text();
      EXPECT_LT(columns.mean(), 0.4 * kPaintByte) << c.direction << ": " << columns.text();
    }
  }
}

// Paper 000, section 6.1: foam on the up-wind sides of waves, which face where the wind comes from; and where
// the horizontal movement draws the water together, which is what the Jacobian says.
TEST_P(OceanPaintTest, foamIsOnTheUpwindSideWhereWaterIsDrawnTogether) {
  const Scene scene = openWater();
  const auto views = viewsFrom(scene, {{1, 14, 2}, {0, 0, 0}, 50}, kPaintWidth, kPaintHeight, GetParam());
  for (const double direction : {40.0, -160.0}) {
    SeaState state;
    state.windDirection = direction, state.choppiness = 1.7, state.wind = 10;
    state.fetch = 5, state.smallest = 2, state.height = 2.5;  // short and steep: many crests
    const SeaReference sea(state, 2.7);
    const SeaReference::Mesh mesh = sea.mesh(9, {0, 0});
    const double amount = 0.7, start = 1;
    Knobs knobs = knobsOf(state);
    knobs.insert(knobs.end(), {{"ocean.paint.foam", std::to_string(amount)},
                               {"ocean.paint.foamStart", std::to_string(start)},
                               {"ocean.paint.foamColor", "#0000FF"}});
    const Frame frame = paint(scene, knobs, 2.7, views);
    const glm::dvec2 wind(std::cos(glm::radians(direction)), std::sin(glm::radians(direction)));
    const Pixels holes = foamStrokes();
    for (size_t v = 0; v < viewCount(); ++v) {
      size_t foamy = 0, bare = 0, wrong = 0;
      size_t bySide = 0, wrongSide = 0;  // where the side decides
      for (int y = 0; y < kPaintHeight; ++y)
        for (int x = 0; x < kPaintWidth; ++x) {
          const std::optional<Water> water = waterAt(mesh, views[v], x, y);
          if (!water || !isWater(frame, v, x, y)) continue;
          const double got = std::sqrt(texel(aov(frame, "lit", v), x, y).z);
          const double along = glm::dot(glm::dvec2(water->normal.x, water->normal.z), wind);
          const double drawn = std::clamp(2.5 * (start - water->jacobian), 0.0, 1.0);
          const glm::dvec3 toEye = glm::normalize(eyeOf(views) - water->at);
          const auto coverAt = [&](double upwind) {
            return 1.6 * amount * drawn * (0.35 + 0.65 * std::clamp(4 * upwind, 0.0, 1.0)) *
                   facing(water->normal, toEye);
          };
          const double cover = coverAt(-along), otherSide = coverAt(along);
          const double hole = patternAt(holes, frame, v, x, y).x;
          // The edge of foam is a fortieth wide; packed gradients move the pattern by less than the rest.
          if (cover - hole > 0.07 && drawn > 0) ++foamy, wrong += got < 1 - kPaintByte;
          if (cover - hole < -0.07 || drawn == 0) ++bare, wrong += got > kPaintByte;
          if (std::abs(cover - hole) > 0.07 && drawn > 0 && (cover > hole) != (otherSide > hole))
            ++bySide, wrongSide += cover > hole ? got < 0.5 : got > 0.5;
        }
      EXPECT_GT(foamy, 100u);
      EXPECT_GT(bare, 500u);
      EXPECT_LT(double(wrong), 0.01 * double(foamy + bare)) << wrong << " of " << foamy << " and " << bare;
      EXPECT_GT(bySide, 25u);
      EXPECT_LT(wrongSide, bySide / 10);
    }
  }
}

// ---- Strokes ----

// Equations 27 to 30, in the two ways that they shift the place in the bathic map. On calm water all is flat.
TEST_P(OceanPaintTest, liveTextureShiftsThePlaceInTheBathicMap) {
  NOT_WITH_SANITIZERS();
  const Scene scene = openWater();
  const auto views = viewsFrom(scene, {{2, 5, 3}, {0, 0, 0}, 50}, kPaintWidth, kPaintHeight, GetParam());
  const Pixels strokes = seaStrokes();
  struct Case {
    double live, time, spread, falseHorizon;
  };
  for (const Case& c :
       {Case{0.5, 0, 0, 120}, {0.5, 0.5, 0, 120}, {0.7, 2.2, 0.12, 120}, {0.3, 3.1, 0.5, 3}}) {
    const double dither = 0.5, lightDither = 0.25;
    const Frame frame = paint(scene,
                              {{"ocean.wind", "0"},
                               {"ocean.falseHorizon", std::to_string(c.falseHorizon)},
                               {"ocean.paint.live", std::to_string(c.live)},
                               {"ocean.paint.liveSpread", std::to_string(c.spread)},
                               {"ocean.paint.dither", std::to_string(dither)},
                               {"ocean.paint.lightDither", std::to_string(lightDither)}},
                              c.time, views);
    for (size_t v = 0; v < viewCount(); ++v) {
      Difference lit(0.03), shadowed(0.03);
      double least = 1, most = 0;
      for (int y = 0; y < kPaintHeight; ++y)
        for (int x = 0; x < kPaintWidth; ++x) {
          if (!isWater(frame, v, x, y)) continue;
          const glm::dvec3 at(texel(aov(frame, "position", v), x, y));
          const glm::dvec4 t = patternAt(strokes, frame, v, x, y);
          // Each place at a moment of its own; the offset and all strokes fade with the distance.
          const double nearness =
              1 - smoothstep(0.5 * c.falseHorizon, 3 * c.falseHorizon, glm::distance(eyeOf(views), at));
          const double own = std::sin(0.21 * at.x + 0.13 * at.z) + std::sin(-0.11 * at.x + 0.19 * at.z);
          const double phase = 2 * std::numbers::pi * (c.live * c.time + c.spread * nearness * own);
          const double mixed = 0.5 + (0.707 * t.x - 0.707 * t.z) * std::cos(phase) +
                               (-0.408 * t.x + 0.816 * t.y - 0.408 * t.z) * std::sin(phase);
          const double stroke = (std::clamp(mixed, 0.0, 1.0) - 0.5) * glm::mix(0.2, 1.0, nearness);
          const double column = inRamp(0.42 + dither * stroke);
          const glm::dvec4 light = texel(aov(frame, "lit", v), x, y),
                           dark = texel(aov(frame, "shadowed", v), x, y);
          lit.add(std::sqrt(light.x), column);
          lit.add(std::sqrt(light.y), inRamp(0.8 + lightDither * stroke));
          shadowed.add(std::sqrt(dark.x), column);
          shadowed.add(std::sqrt(dark.y), inRamp(0.15 + lightDither * stroke));
          least = std::min(least, column), most = std::max(most, column);
        }
      EXPECT_GT(lit.count, 5000u);
      EXPECT_GT(most - least, 0.2) << "there are strokes";
      // Filter weights have steps of 1/256; packed gradients that are rounded the other way move a blend.
      EXPECT_LT(lit.beyondPart(), 0.01) << c.time << ": " << lit.text();
      EXPECT_LT(shadowed.beyondPart(), 0.01) << c.time << ": " << shadowed.text();
      EXPECT_LT(lit.mean(), 5e-3) << c.time << ": " << lit.text();
    }
  }
}

// ---- Light and shadow ----

// The map holds levels of illumination, too (paper 000, section 6.1): waves that lean towards the light are
// further down in it, those that lean away further up, in light and in shadow, by strokes; and all of it is
// used.
TEST_P(OceanPaintTest, wavesAreLitByHowTheyLean) {
  const Scene scene = openWater();
  const TestFolder folder;
  const std::string grey = folder.file("grey.png");
  ASSERT_TRUE(writePng(grey, Image{1, 1, {"R", "G", "B"}, {0.5f, 0.5f, 0.5f}}).ok());
  SeaState state;
  state.windDirection = 40;
  const SeaReference::Mesh mesh = SeaReference(state, 2.7).mesh(9, {0, 0});
  const auto views = viewsFrom(scene, kOverTheSea, kPaintWidth, kPaintHeight, GetParam());
  for (const double waves : {0.5, 2.0}) {
    Knobs knobs = knobsOf(state);
    knobs.push_back({"ocean.paint.lightWaves", std::to_string(waves)});
    const Frame stroked = paint(scene, knobs, 2.7, views);
    // A pattern of one grey is half of every stroke.
    knobs.push_back({"ocean.metatexture.example", grey});
    const Frame frame = paint(scene, knobs, 2.7, views);
    for (size_t v = 0; v < viewCount(); ++v) {
      Difference lit(kPaintByte), shadowed(kPaintByte);
      size_t byStrokes = 0;
      double least = 1, most = 0;
      for (int y = 0; y < kPaintHeight; ++y)
        for (int x = 0; x < kPaintWidth; ++x) {
          const std::optional<Water> water = waterAt(mesh, views[v], x, y);
          if (!water || !isWater(frame, v, x, y)) continue;
          const glm::dvec3 toSun = glm::normalize(glm::dvec3(kToSun)),
                           toEye = glm::normalize(eyeOf(views) - water->at);
          const double shift = waves * (glm::dot(glm::normalize(water->normal), toSun) - toSun.y) *
                               facing(water->normal, toEye);
          lit.add(std::sqrt(texel(aov(frame, "lit", v), x, y).y), inRamp(0.8 + shift));
          shadowed.add(std::sqrt(texel(aov(frame, "shadowed", v), x, y).y), inRamp(0.15 + shift));
          byStrokes +=
              std::abs(texel(aov(stroked, "lit", v), x, y).y - texel(aov(frame, "lit", v), x, y).y) > 0.01;
          least = std::min(least, shift), most = std::max(most, shift);
        }
      EXPECT_GT(lit.count, 1500u);
      EXPECT_GT(byStrokes, lit.count / 5);
      EXPECT_GT(most - least, 0.1 * waves);
      EXPECT_LT(lit.beyondPart(), 0.02) << waves << ": " << lit.text();
      EXPECT_LT(shadowed.beyondPart(), 0.02) << waves << ": " << shadowed.text();
    }
  }
}

TEST_P(OceanPaintTest, allOfTheBathicMapIsUsed) {
  const Scene scene = openWater();
  std::vector<int> rows(20);
  // As looks have it, but for what else changes colours.
  for (const char* wind : {"7", "14", "20"}) {
    const auto views = viewsFrom(scene, {{-6, 3, -2}, {8, 0, 4}, 60}, kPaintWidth, kPaintHeight, GetParam());
    const OceanPaintParams usual = Look().data().get<OceanPaintParams>();
    const Frame frame = paint(scene,
                              {{"ocean.wind", wind},
                               {"ocean.paint.dither", std::to_string(usual.dither)},
                               {"ocean.paint.lightDither", std::to_string(usual.lightDither)},
                               {"ocean.paint.lightWaves", std::to_string(usual.lightWaves)},
                               {"ocean.metatexture.size", "512"}},
                              3, views);
    for (size_t v = 0; v < viewCount(); ++v)
      for (int y = 0; y < kPaintHeight; ++y)
        for (int x = 0; x < kPaintWidth; ++x)
          if (isWater(frame, v, x, y))
            for (const char* set : {"lit", "shadowed"})
              ++rows[std::min(size_t(20 * std::sqrt(texel(aov(frame, set, v), x, y).y)), size_t(19))];
  }
  for (size_t i = 0; i < rows.size(); ++i)
    EXPECT_GT(rows[i], 10) << 5 * i << " percent down: " << testing::PrintToString(rows);
}

// ---- The mirrored sky ----

// Across the sky map from the sun's azimuth to the other side, down from the horizon to the zenith, where the
// reflected ray goes; whole in the light and half in shadow.
TEST_P(OceanPaintTest, mirrorsTheSkyWhereTheReflectedRayGoes) {
  const Scene scene = openWater();
  SeaState state;
  state.windDirection = 40;
  const SeaReference::Mesh mesh = SeaReference(state, 2.7).mesh(9, {0, 0});
  // The second pair of eyes stands so far apart that it shows between which the sky is mirrored.
  for (const Stand& stand : {kOverTheSea, Stand{{-8, 4, -1}, {0, 0, 0}, 50, 0, 2.5f}}) {
    const auto views = viewsFrom(scene, stand, kPaintWidth, kPaintHeight, GetParam());
    Knobs knobs = knobsOf(state);
    knobs.insert(knobs.end(), {{"ocean.paint.reflection", "4"}, {"ocean.paint.sky", ramp("sky", 0.6, 1)}});
    const Frame frame = paint(scene, knobs, 2.7, views);
    for (size_t v = 0; v < viewCount(); ++v) {
      Difference lit(kPaintByte), shadowed(kPaintByte);
      double least = 1, most = 0;
      for (int y = 0; y < kPaintHeight; ++y)
        for (int x = 0; x < kPaintWidth; ++x) {
          const std::optional<Water> water = waterAt(mesh, views[v], x, y);
          if (!water || !isWater(frame, v, x, y)) continue;
          const glm::dvec3 toEye = glm::normalize(eyeOf(views) - water->at), n = water->normal;
          if (facing(n, toEye) < 1) continue;
          const glm::dvec3 ray = 2 * glm::dot(n, toEye) * n - toEye;
          const double elevation = std::atan2(std::abs(ray.y), std::hypot(ray.x, ray.z));
          const double azimuth = std::abs(std::remainder(
              std::atan2(ray.z, ray.x) - std::atan2(kToSun.z, kToSun.x), 2 * std::numbers::pi));
          const glm::dvec3 sky(inRamp(azimuth / std::numbers::pi), inRamp(elevation / (std::numbers::pi / 2)),
                               0.6);
          const glm::dvec4 light = texel(aov(frame, "lit", v), x, y),
                           dark = texel(aov(frame, "shadowed", v), x, y);
          for (int i = 0; i < 3; ++i) lit.add(std::sqrt(light[i]), sky[i]);
          // Without foam or strokes, green of the water in shadow is its row, and it has no blue.
          shadowed.add(std::sqrt(dark.y), std::sqrt(0.5 * (0.15 * 0.15 + sky.y * sky.y)));
          shadowed.add(std::sqrt(dark.z), std::sqrt(0.5) * 0.6);
          least = std::min(least, sky.x), most = std::max(most, sky.x);
        }
      EXPECT_GT(lit.count, 3000u);
      EXPECT_GT(most - least, 0.3);
      // The map bends at the sun and behind it, where texels are interpolated; crests hide others.
      EXPECT_LT(lit.beyondPart(), 0.02) << lit.text();
      EXPECT_LT(shadowed.beyondPart(), 0.02) << shadowed.text();
    }
  }
}

// (Paper 000, section 6.1: the sky map is distorted by the dithering pattern.)
TEST_P(OceanPaintTest, strokesDistortTheMirroredSky) {
  NOT_WITH_SANITIZERS();
  const Scene scene = openWater();
  const auto views = viewsFrom(scene, {{2, 5, 3}, {0, 0, 0}, 50}, kPaintWidth, kPaintHeight, GetParam());
  const Pixels strokes = seaStrokes();
  for (const double dither : {0.2, 0.6}) {
    const Frame frame = paint(scene,
                              {{"ocean.wind", "0"},
                               {"ocean.paint.live", "0"},
                               {"ocean.paint.liveSpread", "0"},
                               {"ocean.paint.reflection", "4"},
                               {"ocean.paint.skyDither", std::to_string(dither)},
                               {"ocean.paint.sky", ramp("sky", 0.6, 1)}},
                              0, views);
    for (size_t v = 0; v < viewCount(); ++v) {
      Difference sky(0.03);
      double least = 1, most = 0;
      for (int y = 0; y < kPaintHeight; ++y)
        for (int x = 0; x < kPaintWidth; ++x) {
          if (!isWater(frame, v, x, y)) continue;
          const glm::dvec4 t = patternAt(strokes, frame, v, x, y);
          const double stroke = std::clamp(0.5 + 0.707 * (t.x - t.z), 0.0, 1.0) - 0.5;
          const glm::dvec3 at(texel(aov(frame, "position", v), x, y)),
              toEye = glm::normalize(eyeOf(views) - at), ray(-toEye.x, toEye.y, -toEye.z);
          const double elevation = std::atan2(ray.y, std::hypot(ray.x, ray.z)),
                       azimuth = std::abs(std::remainder(
                           std::atan2(ray.z, ray.x) - std::atan2(kToSun.z, kToSun.x), 2 * std::numbers::pi));
          const glm::dvec4 light = texel(aov(frame, "lit", v), x, y);
          sky.add(std::sqrt(light.x), inRamp(azimuth / std::numbers::pi + dither * stroke));
          sky.add(std::sqrt(light.y), inRamp(elevation / (std::numbers::pi / 2) + dither * stroke));
          least = std::min(least, dither * stroke), most = std::max(most, dither * stroke);
        }
      EXPECT_GT(sky.count, 5000u);
      EXPECT_GT(most - least, 0.5 * dither);
      EXPECT_LT(sky.beyondPart(), 0.015) << dither << ": " << sky.text();
    }
  }
}

// Hand-cut shapes: where little is mirrored, the strokes decide where; the map's alpha and the knob say how
// much.
TEST_P(OceanPaintTest, strokesDecideWhereTheSkyIsMirrored) {
  NOT_WITH_SANITIZERS();
  const Scene scene = openWater();
  const auto views = viewsFrom(scene, {{2, 5, 3}, {0, 0, 0}, 50}, kPaintWidth, kPaintHeight, GetParam());
  const Pixels strokes = seaStrokes();
  size_t shownAtAll = 0;
  for (const auto& [reflection, alpha] : {std::pair{0.8, 0.6}, {1.5, 0.3}, {2.0, 0.0}}) {
    const Frame frame = paint(scene,
                              {{"ocean.wind", "0"},
                               {"ocean.paint.live", "0"},
                               {"ocean.paint.liveSpread", "0"},
                               {"ocean.paint.reflection", std::to_string(reflection)},
                               {"ocean.paint.sky", ramp("sky", 0.6, alpha)}},
                              0, views);
    for (size_t v = 0; v < viewCount(); ++v) {
      size_t shown = 0, bare = 0, wrong = 0;
      for (int y = 0; y < kPaintHeight; ++y)
        for (int x = 0; x < kPaintWidth; ++x) {
          if (!isWater(frame, v, x, y)) continue;
          const glm::dvec4 t = patternAt(strokes, frame, v, x, y);
          const double stroke = std::clamp(0.5 + 0.707 * t.x - 0.707 * t.z, 0.0, 1.0);
          const double over = reflection * alpha - 0.5 + 0.9 * (stroke - 0.5);
          // Nothing of blue but the sky has. An edge is 1/14 wide.
          const double got = std::sqrt(texel(aov(frame, "lit", v), x, y).z) / 0.6;
          if (over > 0.08 && alpha > 0) ++shown, wrong += got < 0.97;
          if (over < -0.08 || alpha == 0) ++bare, wrong += got > 0.03;
        }
      EXPECT_GT(bare, 400u) << alpha;
      EXPECT_LT(double(wrong), 0.01 * double(bare))
          << alpha << ": " << wrong << " of " << shown << " and " << bare;
      shownAtAll += shown;
    }
  }
  EXPECT_GT(shownAtAll, 800 * viewCount());
}

}  // namespace
}  // namespace scumble::ocean
