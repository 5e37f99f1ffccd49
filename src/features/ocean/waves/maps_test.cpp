#include "features/ocean/waves/maps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "base/oklab.h"
#include "base/stroke_maps.h"

namespace scumble::ocean {
namespace {

using Field = std::vector<double>;  // kSide x kSide
constexpr uint32_t kSide = 256;

Field channelOf(const Pixels& pixels, size_t channel) {
  Field field;
  for (size_t i = channel; i < pixels.rgba.size(); i += 4) field.push_back(pixels.rgba[i] / 255.0);
  return field;
}

double meanOfField(const Field& field) {
  double sum = 0;
  for (const double value : field) sum += value;
  return sum / double(field.size());
}

double covariance(const Field& a, const Field& b) {
  const double meanA = meanOfField(a), meanB = meanOfField(b);
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - meanA) * (b[i] - meanB);
  return sum / double(a.size());
}

double correlation(const Field& a, const Field& b) {
  return covariance(a, b) / std::sqrt(covariance(a, a) * covariance(b, b));
}

// Mean difference between column (or row) i and the next; after the last comes the first.
double stepBetween(const Field& field, uint32_t i, bool columns) {
  double sum = 0;
  for (uint32_t j = 0; j < kSide; ++j) {
    const auto at = [&](uint32_t k) {
      return columns ? field[j * kSide + k % kSide] : field[k % kSide * kSide + j];
    };
    sum += std::abs(at(i + 1) - at(i));
  }
  return sum / kSide;
}

double meanStep(const Field& field, bool columns) {
  double sum = 0;
  for (uint32_t i = 0; i < kSide; ++i) sum += stepBetween(field, i, columns);
  return sum / kSide;
}

void expectNoSeam(const Field& field) {
  for (const bool columns : {true, false}) {
    double inside = 0;
    for (uint32_t i = 0; i + 1 < kSide; ++i) inside = std::max(inside, stepBetween(field, i, columns));
    EXPECT_LE(stepBetween(field, kSide - 1, columns), inside) << (columns ? "along u" : "along v");
  }
}

// Equation 27, at a phase in turns.
Field liveTexture(const Pixels& texture, double turns) {
  const Field r = channelOf(texture, 0), g = channelOf(texture, 1), b = channelOf(texture, 2);
  const double c = std::cos(2 * std::numbers::pi * turns), s = std::sin(2 * std::numbers::pi * turns);
  Field field(r.size());
  for (size_t i = 0; i < r.size(); ++i)
    field[i] = 0.5 + (0.707 * r[i] - 0.707 * b[i]) * c + (-0.408 * r[i] + 0.816 * g[i] - 0.408 * b[i]) * s;
  return field;
}

glm::dvec3 oklabAt(const Pixels& pixels, uint32_t x, uint32_t y) {
  glm::dvec3 linear;
  for (int c = 0; c < 3; ++c) {
    const double encoded = pixels.rgba[(size_t(y) * pixels.width + x) * 4 + size_t(c)] / 255.0;
    linear[c] = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
  }
  return oklabFromLinear(linear);
}

double meanDistance(const Pixels& a, const Pixels& b) {
  double sum = 0;
  for (uint32_t y = 0; y < a.height; ++y)
    for (uint32_t x = 0; x < a.width; ++x) sum += glm::length(oklabAt(a, x, y) - oklabAt(b, x, y));
  return sum / (double(a.width) * a.height);
}

// Degrees between two hues.
double hueBetween(const glm::dvec3& a, const glm::dvec3& b) {
  const double turn = std::atan2(a.z, a.y) - std::atan2(b.z, b.y);
  return std::abs(std::remainder(turn, 2 * std::numbers::pi)) * 180 / std::numbers::pi;
}

// Texels of the smallest connected part (by edges, across the borders of the map) of what is `wanted`.
size_t smallestPart(const std::vector<bool>& map, bool wanted) {
  std::vector<bool> seen(map.size());
  size_t smallest = map.size();
  for (size_t start = 0; start < map.size(); ++start) {
    if (map[start] != wanted || seen[start]) continue;
    std::vector<size_t> open{start};
    seen[start] = true;
    size_t count = 0;
    while (!open.empty()) {
      const size_t at = open.back(), x = at % kSide, y = at / kSide;
      open.pop_back(), ++count;
      for (const size_t next : {y * kSide + (x + 1) % kSide, y * kSide + (x + kSide - 1) % kSide,
                                (y + 1) % kSide * kSide + x, (y + kSide - 1) % kSide * kSide + x})
        if (map[next] == wanted && !seen[next]) seen[next] = true, open.push_back(next);
    }
    smallest = std::min(smallest, count);
  }
  return smallest;
}

std::vector<bool> foamAt(const Field& foam, double cover) {
  std::vector<bool> map;
  for (const double value : foam) map.push_back(value < cover);
  return map;
}

TEST(OceanMaps, sizesAreAsToldAndAllTogetherAreSmall) {
  size_t bytes = 0;
  const auto expectSize = [&](const Pixels& pixels, uint32_t width, uint32_t height) {
    EXPECT_EQ(pixels.width, width);
    EXPECT_EQ(pixels.height, height);
    EXPECT_EQ(pixels.rgba.size(), size_t(4) * width * height);
    bytes += pixels.rgba.size();
  };
  expectSize(seaStrokes(), 256, 256);
  expectSize(foamStrokes(), 256, 256);
  for (const Mood mood : kMoods) expectSize(bathic(mood), 128, 64), expectSize(sky(mood), 64, 64);
  EXPECT_LT(bytes, size_t(1) << 20);
}

// Painted anew only on purpose: films that are rendered on several machines must show the same sea.
TEST(OceanMaps, bytesAreTheSameOnEveryMachine) {
  EXPECT_EQ(contentsOf(seaStrokes()), 6097162540269532083u);
  EXPECT_EQ(contentsOf(foamStrokes()), 7854461148096682127u);
  constexpr uint64_t kBathic[] = {6711747313752645884u, 1390345099748016055u, 8827935792256990457u,
                                  9017822998217676588u};
  constexpr uint64_t kSky[] = {7733473709996064645u, 6671166126897616038u, 3293355928928932074u,
                               9238346210735185791u};
  for (const Mood mood : kMoods) {
    EXPECT_EQ(contentsOf(bathic(mood)), kBathic[int(mood)]) << nameOf(mood);
    EXPECT_EQ(contentsOf(sky(mood)), kSky[int(mood)]) << nameOf(mood);
  }
}

TEST(OceanMaps, ditherAndFoamHaveNoSeam) {
  const Pixels strokes = seaStrokes();
  for (size_t c = 0; c < 3; ++c) expectNoSeam(channelOf(strokes, c));
  expectNoSeam(channelOf(foamStrokes(), 0));
}

TEST(OceanMaps, ditherHasFiveFlatTonesInEqualParts) {
  const Pixels strokes = seaStrokes();
  for (size_t c = 0; c < 3; ++c) {
    const Field field = channelOf(strokes, c);
    EXPECT_NEAR(meanOfField(field), 0.5, 0.005) << c;
    std::array<size_t, 256> counts{};
    for (size_t i = c; i < strokes.rgba.size(); i += 4) ++counts[strokes.rgba[i]];
    double flat = 0;
    for (int tone = 0; tone < 5; ++tone) {
      // The most frequent value of each fifth of the range.
      const size_t most = *std::max_element(counts.begin() + tone * 51, counts.begin() + (tone + 1) * 51);
      EXPECT_GT(double(most) / field.size(), 0.11) << c << " tone " << tone;
      EXPECT_LT(double(most) / field.size(), 0.25) << c << " tone " << tone;
      flat += double(most) / field.size();
    }
    EXPECT_GT(flat, 0.8) << c;
    EXPECT_NEAR(std::sqrt(covariance(field, field)), 0.283, 0.01) << c;
  }
}

TEST(OceanMaps, channelsOfDitherKnowNothingOfEachOther) {
  const Pixels strokes = seaStrokes();
  for (size_t c = 0; c < 3; ++c)
    EXPECT_LT(std::abs(correlation(channelOf(strokes, c), channelOf(strokes, (c + 1) % 3))), 0.15) << c;
}

TEST(OceanMaps, everyMixOfTheLiveTextureIsStrokesOfTheSameStrength) {
  const Pixels strokes = seaStrokes();
  for (int eighth = 0; eighth < 8; ++eighth) {
    const Field mix = liveTexture(strokes, eighth / 8.0);
    EXPECT_NEAR(meanOfField(mix), 0.5, 0.005) << eighth;
    EXPECT_NEAR(std::sqrt(covariance(mix, mix)), 0.283, 0.02) << eighth;
    EXPECT_GT(meanStep(mix, false), 2.5 * meanStep(mix, true)) << "strokes lie along u; mix " << eighth;
    expectNoSeam(mix);
    // It changes, and not by a jump.
    EXPECT_NEAR(correlation(mix, liveTexture(strokes, (eighth + 1) / 8.0)), 0.707, 0.1) << eighth;
    EXPECT_NEAR(correlation(mix, liveTexture(strokes, (eighth + 2) / 8.0)), 0, 0.15) << eighth;
  }
}

TEST(OceanMaps, foamCoversWhatIsAskedFor) {
  const Field field = channelOf(foamStrokes(), 0);
  double before = -1;
  for (int percent = 5; percent <= 95; percent += 5) {
    const std::vector<bool> map = foamAt(field, percent / 100.0);
    const double cover = double(std::count(map.begin(), map.end(), true)) / double(map.size());
    EXPECT_NEAR(cover, percent / 100.0, 0.02);
    EXPECT_GT(cover, before);
    before = cover;
  }
  const auto [least, most] = std::minmax_element(field.begin(), field.end());
  EXPECT_GT(*least, 0.0);
  EXPECT_LT(*most, 1.0);
}

TEST(OceanMaps, foamIsCutByOneBrush) {
  const Field field = channelOf(foamStrokes(), 0);
  for (const double cover : {0.2, 0.5, 0.8}) {
    const std::vector<bool> map = foamAt(field, cover);
    EXPECT_GE(smallestPart(map, true), 9u) << cover;
    EXPECT_GE(smallestPart(map, false), 9u) << cover;
  }
  EXPECT_GT(meanStep(field, false), 1.8 * meanStep(field, true)) << "streaks lie along u";
}

TEST(OceanMaps, bathicGetsLighterTowardsCrestAndLight) {
  for (const Mood mood : kMoods) {
    const Pixels water = bathic(mood);
    for (uint32_t y = 0; y < water.height; ++y)
      for (uint32_t x = 0; x < water.width; ++x) {
        const double here = oklabAt(water, x, y).x;
        // A step of one code is rounding.
        const double left = x > 0 ? oklabAt(water, x - 1, y).x : 0,
                     above = y > 0 ? oklabAt(water, x, y - 1).x : 0;
        EXPECT_GE(here, std::max(left, above) - 0.002) << nameOf(mood) << ' ' << x << ' ' << y;
      }
    for (const uint32_t y : {0u, 63u}) EXPECT_GT(oklabAt(water, 127, y).x, oklabAt(water, 0, y).x + 0.25);
    for (const uint32_t x : {0u, 64u, 127u})
      EXPECT_GT(oklabAt(water, x, 63).x, oklabAt(water, x, 0).x + 0.02);
  }
}

TEST(OceanMaps, bathicIsFlatBands) {
  for (const Mood mood : kMoods) {
    const Pixels water = bathic(mood);
    for (uint32_t y = 0; y < water.height; ++y) {
      int bands = 1, flat = 0;
      bool inBand = true;
      for (uint32_t x = 1; x < water.width; ++x) {
        const bool same = glm::length(oklabAt(water, x, y) - oklabAt(water, x - 1, y)) < 0.002;
        flat += same;
        bands += same && !inBand;
        inBand = same;
      }
      EXPECT_EQ(bands, 6) << nameOf(mood) << " row " << y;
      EXPECT_GT(flat, 90) << nameOf(mood) << " row " << y;
    }
  }
}

TEST(OceanMaps, shadowOnWaterIsAColor) {
  constexpr glm::dvec3 kBlueViolet{0, 0.02, -0.1};
  for (const Mood mood : kMoods) {
    const Pixels water = bathic(mood);
    for (uint32_t x = 0; x < water.width; ++x) {
      const glm::dvec3 shadow = oklabAt(water, x, 0), light = oklabAt(water, x, 63);
      EXPECT_GT(shadow.x, 0.5 * light.x) << nameOf(mood) << ' ' << x;
      EXPECT_GT(hueBetween(shadow, light), 15) << nameOf(mood) << ' ' << x;
      EXPECT_LT(hueBetween(shadow, kBlueViolet), hueBetween(light, kBlueViolet) - 15)
          << "towards blue-violet; " << nameOf(mood) << ' ' << x;
      EXPECT_GT(std::hypot(shadow.y, shadow.z), 0.02) << "not grey; " << nameOf(mood) << ' ' << x;
    }
  }
}

TEST(OceanMaps, openSeaHasTheBriefsColors) {
  const Pixels water = bathic(Mood::openSea);
  std::set<uint32_t> colors;
  for (uint32_t x = 0; x < 128; ++x) {
    const uint8_t* c = &water.rgba[(63 * 128 + x) * 4];
    colors.insert(uint32_t(c[0]) << 16 | uint32_t(c[1]) << 8 | c[2]);
  }
  for (const uint32_t color : {0x163A50u, 0x1F4A63u, 0x2B6E80u, 0x3F8F96u})
    EXPECT_TRUE(colors.contains(color)) << std::hex << color;
}

TEST(OceanMaps, skyShowsMostLowAndTowardsTheSun) {
  for (const Mood mood : kMoods) {
    const Pixels reflected = sky(mood);
    const auto shown = [&](uint32_t x, uint32_t y) { return int(reflected.rgba[(y * 64 + x) * 4 + 3]); };
    for (uint32_t y = 0; y < 64; ++y)
      for (uint32_t x = 0; x < 64; ++x) {
        if (y > 0) {
          EXPECT_LE(shown(x, y), shown(x, y - 1)) << nameOf(mood) << ' ' << x << ' ' << y;
        }
        if (x > 0) {
          EXPECT_LE(shown(x, y), shown(x - 1, y)) << nameOf(mood) << ' ' << x << ' ' << y;
        }
      }
    EXPECT_GT(shown(0, 0), 170) << nameOf(mood);
    EXPECT_LT(shown(63, 63), 50) << nameOf(mood);
    EXPECT_GT(oklabAt(reflected, 0, 0).x, oklabAt(reflected, 63, 63).x + 0.15) << nameOf(mood);
  }
}

TEST(OceanMaps, moodsDiffer) {
  std::set<std::string> names;
  for (const Mood a : kMoods) {
    names.insert(nameOf(a));
    for (const Mood b : kMoods) {
      if (a >= b) continue;
      EXPECT_GT(meanDistance(bathic(a), bathic(b)), 0.05) << nameOf(a) << ' ' << nameOf(b);
      EXPECT_GT(meanDistance(sky(a), sky(b)), 0.05) << nameOf(a) << ' ' << nameOf(b);
    }
  }
  EXPECT_EQ(names.size(), std::size(kMoods));
}

}  // namespace
}  // namespace scumble::ocean
