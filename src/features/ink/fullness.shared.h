// Whether a place on an edge is seen, how full its line is there, and where it lies: C++ and GLSL compile the
// same text, so that drawings hide the lines that pictures hide.
#ifndef SCUMBLE_INK_FULLNESS_SHARED_H
#define SCUMBLE_INK_FULLNESS_SHARED_H
#include "../../shading/shared_types.h"

#ifdef __cplusplus
namespace scumble::shared {
using glm::floor;
using glm::max;
using glm::min;
using glm::mix;
using glm::smoothstep;
}  // namespace scumble::shared
#endif

SHARED_BEGIN

// By how much something may be before an edge and hide nothing: a part of its distance or (in parallel
// projections) of the scene's radius, which is what rounding does and what levels of detail leave out; and
// what some pixels measure there. And what hides all of it. In a valley the surface comes nearer on both
// sides.
const float kInkTolerance = 0.0015f, kInkTolerancePixels = 1.0f, kInkValleyTolerancePixels = 3.0f;
const float kInkHides = 0.0045f, kInkHidesPixels = 4.0f, kInkValleyHidesPixels = 12.0f;
// Where depth is looked up beside an edge, pixels: beyond it, twice, and before it.
const float kInkBeyond = 1.5f, kInkFarBeyond = 2.6f, kInkBefore = 1.5f;
// How full a line is, is the mean of what is found at a place and so many pixels before and behind it.
const float kInkMeanOver = 2.0f;
// Over how many pixels an outline ends that is not drawn along its whole edge.
const float kInkSoftEnd = 8.0f;

// What is known of a place on an edge. Lengths are metres.
struct InkPlace {
  float distance;  // along the view axis
  float beyond;    // the same of what lies beyond the edge, the farther of the two
  float before;    // of what lies before it
  float pixel;     // that a pixel covers
  float radius;    // of the line, pixels
  vec2 turn;       // as LineRecord has it
  float reach;     // inkReach there
  uint isOutline, isValley;
};

// How much of an outline is drawn at a place along its edge, from 0 to 1. `reach`: as LineRecord has it; all
// of it where that is 0 and 1. `size`: the edge's length, pixels.
SHARED_FUNCTION float inkReach(float along, vec2 reach, float size) {
  float soft = min(kInkSoftEnd / max(size, 1e-3f), 0.5f);
  along = min(max(along, 0.0f), 1.0f);  // beyond its ends the line goes on as it is there
  float from = reach.x * (1.0f + soft) - soft, to = reach.y * (1.0f + soft);
  return smoothstep(from, from + soft, along) * (1.0f - smoothstep(to - soft, to, along));
}

// Whether a surface is beside a place along an edge, from 0 to 1. `seen`: as EdgeRing has it.
SHARED_FUNCTION float inkSeen(float along, uint seen) {
  float at = min(max(along, 0.0f), 1.0f) * 32.0f - 0.5f;
  float before = min(max(floor(at), 0.0f), 31.0f), after = min(before + 1.0f, 31.0f);
  return mix(float(seen >> uint(before) & 1u), float(seen >> uint(after) & 1u),
             min(max(at - before, 0.0f), 1.0f));
}

// A depth at a place along an edge, or a little beyond its ends, which may be close on the screen and not in
// depth. `atA`, `atB`: at its ends, of what is linear on the screen.
SHARED_FUNCTION float inkDepthAlong(float atA, float atB, float along) {
  return max(mix(atA, atB, min(max(along, -0.5f), 1.5f)), 0.5f * min(atA, atB));
}

// A factor on the line's width; 0 where it is hidden. `parallel`: 1 for a parallel projection, else 0;
// `fade`, `outer`: as InkUniforms has them.
//
// What lies just beside the edge on both sides tells whether something is before it: if the farther of the
// two is nearer than the edge. So there is nothing to fight with about depths, and a line is hidden over its
// whole width at once.
SHARED_FUNCTION float inkFullness(InkPlace p, float sceneRadius, float parallel, float fade, float outer) {
  // What is hidden comes and goes by how deep it lies, and never at once.
  float scale = mix(p.distance, sceneRadius, parallel);
  float tolerance = p.isValley != 0u ? kInkValleyTolerancePixels : kInkTolerancePixels;
  float hides = p.isValley != 0u ? kInkValleyHidesPixels : kInkHidesPixels;
  float hidden = smoothstep(kInkTolerance * scale + tolerance * p.pixel, kInkHides * scale + hides * p.pixel,
                            p.distance - max(p.beyond, p.before));
  if (p.isOutline == 0u) return 1.0f - hidden;
  // An outline tapers where the form goes on right behind it, so that it neither begins nor ends at once; but
  // the fold of a coarse form has depth until it closes, and tapers by its angle.
  float behind = min(p.beyond, 1e6f * p.distance) - p.distance;
  float full = 2.0f * fade * max(p.radius, 0.5f) * p.pixel, far = behind / sceneRadius;
  float fullness =
      mix(1.0f, outer, smoothstep(0.1f, 0.4f, far)) * smoothstep(0.0f, 1.0f, behind / max(full, 1e-20f));
  // Against the rest of the world it is whole.
  fullness *= mix(p.turn.x * p.reach, 1.0f, smoothstep(0.2f, 0.6f, far));
  return (1.0f - hidden) * max(fullness, p.turn.y);
}

// How far outlines that lie outside of their form reach into it, pixels: two anti-aliased edges that only
// touch would leave a light seam, and so would two that are torn apart. `pixelScale`: pixels of a knob pixel.
SHARED_FUNCTION float inkOverlap(float pixelScale) {
  return max(0.75f, 2.4f * pixelScale);
}

SHARED_END
#endif
