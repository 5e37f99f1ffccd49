// What a brush leaves within a splat, and how much each of the splats along a stroke counts. C++ and GLSL
// compile the same text, so that what is baked is what is drawn.
#ifndef SCUMBLE_BRUSH_SHARED_H
#define SCUMBLE_BRUSH_SHARED_H
#include "shared_types.h"

#ifdef __cplusplus
namespace scumble::shared {
using glm::abs;
using glm::clamp;
using glm::exp;
using glm::max;
using glm::mix;
using glm::pow;
using glm::smoothstep;
}  // namespace scumble::shared
#endif

SHARED_BEGIN

// scene::Brush
const int kPlain = 0, kBristles = 1, kWash = 2, kSpatter = 3, kLight = 4, kGaussian = 5;
const float kLeastPixels = 0.7f;  // between splats

// How far apart splats lie that count, radii. `spacing`: as it is wanted, radii; `pixel`: what a pixel
// measures there, metres.
SHARED_FUNCTION float splatsApart(float spacing, float pixel, float radius) {
  return max(spacing, kLeastPixels * pixel / max(radius, 1e-30f));
}

// How much a splat counts: where fewer serve as well, all but every second one fade out, then all but every
// fourth. `sine`: of the angle between stroke and line of sight; `own`: radii to the next splat that counts
// at least as much.
SHARED_FUNCTION float splatFade(float apart, float sine, float own) {
  return clamp(2.0f - apart / max(sine, 0.15f) / own, 0.0f, 1.0f);
}

// How opaque a splat is, so that as many as lie over a place together are as opaque as the stroke. Light is
// added: there it is their sum. A Gaussian is as opaque as it says.
SHARED_FUNCTION float splatOpacity(int brush, float opacity, float apart) {
  float within = clamp(0.5f * apart, 0.0f, 1.0f), most = clamp(opacity, 0.0f, 0.9995f);
  if (brush == kGaussian) return most;
  return brush == kLight ? 2.0f * most * within : 1.0f - pow(1.0f - most, within);
}

struct BrushPlace {
  vec2 place;      // within the splat, radii: along the stroke, and across
  float from, to;  // of its middle: from the stroke's beginning, and to its end, radii
  float pixels;    // how many its radius is
  float chance;    // of the stroke, from 0 to 1
};

// Where the picture of bristles is looked up. It lies on the stroke, so that its splats agree.
SHARED_FUNCTION vec2 bristlesAt(BrushPlace p) {
  return vec2(0.03f * (p.from + p.place.x) + p.chance, 0.31f * p.place.y + 7.0f * p.chance);
}

// Drops, at most one in each cell of a grid on the stroke.
SHARED_FUNCTION float dropsAt(BrushPlace p) {
  const float kCells = 2.2f;  // a radius
  vec2 place = kCells * vec2(p.from + p.place.x, p.place.y), cell = floor(place);
  uvec2 key = uvec2(ivec2(cell)) + uint(p.chance * 65536.0f);
  uint h = key.x * 0x9E3779B9u ^ key.y * 0x85EBCA6Bu;
  h = (h ^ h >> 15) * 0x2C1B3C6Du;
  h = (h ^ h >> 12) * 0x297A2D39u;
  h = h ^ h >> 15;
  float third = float(h >> 16 & 255u) / 255.0f;
  float size = mix(0.08f, 0.34f, third * third);
  vec2 middle = size + (1.0f - 2.0f * size) * vec2(float(h & 255u), float(h >> 8 & 255u)) / 255.0f;
  float soft = kCells / max(p.pixels, 1.0f);
  return 1.0f - smoothstep(size - soft, size + 0.01f, length(place - cell - middle));
}

// How much of a place a splat covers. `mark`: what the picture of bristles has there; `streaks`: how far they
// part the paint; `dryEnds`: over how many radii a stroke ends dry.
SHARED_FUNCTION float brushCovers(int brush, BrushPlace p, float mark, float streaks, float dryEnds) {
  float away = length(p.place);
  float covers = clamp((1.0f - away) * p.pixels + 0.5f, 0.0f, 1.0f), soft = max(1.0f - away * away, 0.0f);
  if (brush == kBristles) {
    float ends = 1.0f - smoothstep(0.0f, max(dryEnds, 1e-3f), p.to - p.place.x);
    float dry = streaks * (0.35f + 0.65f * max(smoothstep(0.0f, 1.0f, abs(p.place.y)), ends));
    covers *= smoothstep(dry - 0.25f, dry + 0.05f, mark + 0.45f);
  } else if (brush == kWash) {
    covers = 0.35f * soft * soft;
  } else if (brush == kSpatter) {
    covers *= dropsAt(p);
  } else if (brush == kLight) {
    covers = soft * soft * soft;
  } else if (brush == kGaussian) {
    covers = exp(-2.0f * away * away);  // two standard deviations are its radius
  }
  return covers;
}

SHARED_END
#endif
