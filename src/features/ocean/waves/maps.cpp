#include "features/ocean/waves/maps.h"

#include <algorithm>
#include <array>

namespace scumble::ocean {

namespace {

constexpr int kOne = 256;  // weights and places are in 1/256

struct Color {
  int r, g, b;
};
constexpr Color rgb(uint32_t hex) {
  return {int(hex >> 16), int(hex >> 8 & 255), int(hex & 255)};
}

int mix(int a, int b, int weight) {
  return (a * (kOne - weight) + b * weight + kOne / 2) / kOne;
}
Color mix(const Color& a, const Color& b, int weight) {
  return {mix(a.r, b.r, weight), mix(a.g, b.g, weight), mix(a.b, b.b, weight)};
}

// From 0 to kOne, while x passes an edge that is `width` wide.
int pass(int x, int edge, int width) {
  const int t = std::clamp((x - edge) * kOne / width + kOne / 2, 0, kOne);
  return t * t * (3 * kOne - 2 * t) / (kOne * kOne);
}

// Three flat steps: shadow, half light, light.
int inSteps(int x) {
  return (pass(x, 88, 56) + pass(x, 176, 56)) / 2;
}

// How the water looks in one mood: bands from the trough to the crest.
constexpr size_t kBands = 6;
struct Water {
  std::array<Color, kBands> light, shadow;
};

Water waterOf(Mood mood) {
  switch (mood) {
    // Milky, with the sky's first rose and gold on what is thin.
    case Mood::calmMorning:
      return {{rgb(0x467583), rgb(0x5B8C97), rgb(0x78A5A8), rgb(0x9CC3C4), rgb(0xC6D6C4), rgb(0xF1DDBB)},
              {rgb(0x3F5580), rgb(0x4F6891), rgb(0x6680A3), rgb(0x8299B6), rgb(0xA09FBC), rgb(0xBDAFC0)}};
    case Mood::openSea:
      return {{rgb(0x163A50), rgb(0x1F4A63), rgb(0x2B6E80), rgb(0x3F8F96), rgb(0x62B39C), rgb(0xA9DDB2)},
              {rgb(0x162A4C), rgb(0x1D365C), rgb(0x264F78), rgb(0x356A90), rgb(0x4384A0), rgb(0x69A4B4)}};
    // Grey-green; its shadow is nearly black, and the crest is the only pale thing.
    case Mood::storm:
      return {{rgb(0x1E2E35), rgb(0x293E40), rgb(0x38534F), rgb(0x4C6C60), rgb(0x728D78), rgb(0xB9C6A6)},
              {rgb(0x162430), rgb(0x1C313D), rgb(0x263F4D), rgb(0x34515F), rgb(0x4A6672), rgb(0x7E939D)}};
    // Teal below an apricot sky: shadow turns towards violet, and the crest takes the sun's colour.
    case Mood::evening:
      return {{rgb(0x1D4A5E), rgb(0x276173), rgb(0x337A86), rgb(0x4B9696), rgb(0x94AE8C), rgb(0xF2C488)},
              {rgb(0x1F375F), rgb(0x2B486F), rgb(0x395A80), rgb(0x4C6E90), rgb(0x717B9B), rgb(0xAA8896)}};
  }
  return {};
}

// Bands of the sky from the horizon up, towards the sun and away from it, and how much water shows of them.
constexpr size_t kSkyBands = 5;
struct Sky {
  std::array<Color, kSkyBands> toSun, away;
  std::array<int, kSkyBands> shownToSun, shownAway;  // in 1/255
  Color glow;                                        // low below the sun
  int shownGlow;
};

Sky skyOf(Mood mood) {
  switch (mood) {
    case Mood::calmMorning:
      return {{rgb(0xFBE0BC), rgb(0xF5D2B6), rgb(0xE2C7BE), rgb(0xC2C8CC), rgb(0xA6C2CC)},
              {rgb(0xE6D5CC), rgb(0xD0CCD3), rgb(0xB7C6D4), rgb(0xA0BDCF), rgb(0x8DB1C7)},
              {190, 140, 90, 54, 30},
              {170, 124, 80, 48, 30},
              rgb(0xFFF0CE),
              225};
    case Mood::openSea:
      return {{rgb(0xF4DEBC), rgb(0xDCD6C0), rgb(0xB8CFC6), rgb(0x9CC3C4), rgb(0x7DAFBF)},
              {rgb(0xD6DCCF), rgb(0xB5CECB), rgb(0x97BFC6), rgb(0x7EAEC0), rgb(0x679BB6)},
              {180, 125, 75, 42, 24},
              {150, 105, 64, 36, 24},
              rgb(0xFFF1D2),
              215};
    case Mood::storm:
      return {{rgb(0xAEB4A6), rgb(0x97A09A), rgb(0x7F8D8B), rgb(0x63767B), rgb(0x505F6C)},
              {rgb(0x8D989A), rgb(0x72828A), rgb(0x5C6E79), rgb(0x4C5D6A), rgb(0x404D5E)},
              {150, 100, 60, 36, 20},
              {115, 80, 50, 30, 20},
              rgb(0xBCC0AE),
              185};
    case Mood::evening:
      return {{rgb(0xFFD798), rgb(0xF8B579), rgb(0xEB996E), rgb(0xC48888), rgb(0x8B83A2)},
              {rgb(0xE6B59A), rgb(0xC99C9D), rgb(0xA38FA6), rgb(0x7D86A6), rgb(0x5E7799)},
              {180, 132, 82, 46, 26},
              {145, 104, 66, 38, 26},
              rgb(0xFFEBB4),
              230};
  }
  return {};
}

void add(Pixels& pixels, const Color& color, int alpha) {
  pixels.rgba.insert(pixels.rgba.end(),
                     {uint8_t(color.r), uint8_t(color.g), uint8_t(color.b), uint8_t(alpha)});
}

// The middle of texel i of `count`.
int placeOf(int i, int count) {
  return (2 * i + 1) * kOne / (2 * count);
}

}  // namespace

const char* nameOf(Mood mood) {
  switch (mood) {
    case Mood::calmMorning:
      return "calm-morning";
    case Mood::openSea:
      return "open-sea";
    case Mood::storm:
      return "storm";
    case Mood::evening:
      return "evening";
  }
  return "";
}

Pixels bathic(Mood mood) {
  constexpr int kWidth = 128, kHeight = 64;
  // Where bands meet, and how far light draws the border towards the trough: each drifts in its own way.
  constexpr std::array<int, kBands - 1> kEdges = {48, 96, 142, 188, 232};
  constexpr std::array<int, kBands - 1> kDrift = {10, 26, 14, 30, 16};
  const Water water = waterOf(mood);
  Pixels pixels{kWidth, kHeight, {}};
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const int u = placeOf(x, kWidth), v = placeOf(y, kHeight), lit = inSteps(v);
      Color color = mix(water.shadow[0], water.light[0], lit);
      for (size_t band = 1; band < kBands; ++band) {
        const int drift = band % 2 ? v : v * v / kOne;
        const int edge = kEdges[band - 1] + kDrift[band - 1] * (kOne / 2 - drift) / kOne;
        color = mix(color, mix(water.shadow[band], water.light[band], lit), pass(u, edge, 10));
      }
      add(pixels, color, 255);
    }
  return pixels;
}

Pixels sky(Mood mood) {
  constexpr int kSide = 64;
  constexpr std::array<int, kSkyBands - 1> kEdges = {26, 64, 114, 172};
  const Sky sky = skyOf(mood);
  Pixels pixels{kSide, kSide, {}};
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const int u = placeOf(x, kSide), v = placeOf(y, kSide), away = inSteps(u);
      Color color = mix(sky.toSun[0], sky.away[0], away);
      int shown = mix(sky.shownToSun[0], sky.shownAway[0], away);
      for (size_t band = 1; band < kSkyBands; ++band) {
        // Towards the sun the warm bands reach higher.
        const int edge = kEdges[band - 1] * (kOne + (kOne - u) * (kOne - u) / (3 * kOne)) / kOne;
        const int weight = pass(v, edge, 16);
        color = mix(color, mix(sky.toSun[band], sky.away[band], away), weight);
        shown = mix(shown, mix(sky.shownToSun[band], sky.shownAway[band], away), weight);
      }
      // A quarter of an ellipse: so far the sun glitters to its sides, 16 degrees, and up.
      const int glow = kOne - pass(u * u / 2 + v * v / 12, kOne, 128);
      add(pixels, mix(color, sky.glow, glow), mix(shown, sky.shownGlow, glow));
    }
  return pixels;
}

}  // namespace scumble::ocean
