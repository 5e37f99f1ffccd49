// Whether a place on an edge is seen, how full its line is there, and where it lies: C++ and GLSL compile the
// same text, so that drawings hide the lines that pictures hide.
#ifndef SCUMBLE_INK_FULLNESS_SHARED_H
#define SCUMBLE_INK_FULLNESS_SHARED_H
#include "../../shading/shared_types.h"

#ifdef __cplusplus
namespace scumble::shared {
using glm::max;
using glm::min;
using glm::mix;
using glm::smoothstep;
}  // namespace scumble::shared
#endif

SHARED_BEGIN

// By how much something may be before an edge and hide nothing, as a part of its distance, or (in parallel
// projections) of the scene's radius: what rounding does, and what levels of detail leave out.
const float kInkTolerance = 0.0015f;
// Where depth is looked up beside an edge, pixels: beyond it, twice, and before it.
const float kInkBeyond = 1.5f, kInkFarBeyond = 2.6f, kInkBefore = 1.5f;

// What is known of a place on an edge. Lengths are metres.
struct InkPlace {
  float distance;  // along the view axis
  float beyond;    // the same of what lies beyond the edge, the farther of the two
  float before;    // of what lies before it
  float pixel;     // that a pixel covers
  float radius;    // of the line, pixels
  vec2 turn;       // as LineRecord has it
  uint isOutline;
};

// A factor on the line's width; 0 where it is hidden. `parallel`: 1 for a parallel projection, else 0;
// `fade`, `outer`: as InkUniforms has them.
//
// What lies just beside the edge on both sides tells whether something is before it: if the farther of the
// two is nearer than the edge. So there is nothing to fight with about depths, and a line is hidden over its
// whole width at once.
SHARED_FUNCTION float inkFullness(InkPlace p, float sceneRadius, float parallel, float fade, float outer) {
  // On both sides of an inner line in a valley the surface comes nearer, also of one that is an outline and
  // stands on something.
  bool isFree = p.isOutline != 0u && p.turn.y <= 0.0f;
  float tolerance = kInkTolerance * mix(p.distance, sceneRadius, parallel) + (isFree ? 0.0f : 3.0f * p.pixel);
  if (max(p.beyond, p.before) < p.distance - tolerance) return 0.0f;
  if (p.isOutline == 0u) return 1.0f;
  // An outline tapers where the form goes on right behind it, so that it neither begins nor ends at once; but
  // the fold of a coarse form has depth until it closes, and tapers by its angle.
  float behind = min(p.beyond, 1e6f * p.distance) - p.distance;
  float full = 2.0f * fade * max(p.radius, 0.5f) * p.pixel, far = behind / sceneRadius;
  float fullness =
      mix(1.0f, outer, smoothstep(0.1f, 0.4f, far)) * smoothstep(0.0f, 1.0f, behind / max(full, 1e-20f));
  return max(fullness * mix(p.turn.x, 1.0f, smoothstep(0.05f, 0.2f, far)), p.turn.y);
}

// How far outlines that lie outside of their form reach into it, pixels: two anti-aliased edges that only
// touch would leave a light seam, and so would two that are torn apart. `pixelScale`: pixels of a knob pixel.
SHARED_FUNCTION float inkOverlap(float pixelScale) {
  return max(0.75f, 2.4f * pixelScale);
}

SHARED_END
#endif
