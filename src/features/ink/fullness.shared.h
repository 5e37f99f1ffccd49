// Whether a place on an edge is seen, how full its line is there, and where it lies: C++ and GLSL compile the
// same text, so that drawings hide the lines that pictures hide.
#ifndef SCUMBLE_INK_FULLNESS_SHARED_H
#define SCUMBLE_INK_FULLNESS_SHARED_H
#include "../../shading/shared_types.h"

#ifdef __cplusplus
namespace scumble::shared {
using glm::abs;
using glm::floor;
using glm::max;
using glm::min;
using glm::mix;
using glm::smoothstep;
}  // namespace scumble::shared
#endif

SHARED_BEGIN

// By how much a surface may lie before an edge and hide nothing: so many pixels, as what they measure there.
// By how much it may lie elsewhere than where the edge's own surface leads: as much, and a part of how far
// that is. Twice that hides all of it.
const float kInkTolerance = 0.5f, kInkSlopeTolerance = 0.06f;
const float kInkExtends = 1.0f;    // pixels
const float kInkRisesMost = 1.5f;  // tangent
// Places beside an edge at which depth is looked up, pixels: two beyond it and two before it.
const float kInkBeyond = 1.5f, kInkFarBeyond = 2.6f, kInkBefore = 1.5f, kInkFarBefore = 3.0f;
// How full a line is, is the mean of what is found at a place and so many pixels before and behind it.
const float kInkMeanOver = 2.0f;
// Over how many pixels an outline ends that is not drawn along its whole edge.
const float kInkSoftEnd = 8.0f;

// What is known of a place on an edge. Lengths are metres.
struct InkPlace {
  float distance;  // along the view axis
  float beyond;    // the same of what lies beyond the edge, the farther of the two
  float hidden;    // inkHidden of what lies around it
  float pixel;     // that a pixel covers
  float radius;    // of the line, pixels
  vec2 turn;       // as LineRecord has it
  float reach;     // inkReach there
  uint isOutline;
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

// How far away a place along an edge is, metres, from inkDepthAlong() there (`extended`) and at the nearer of
// its ends (`end`), if it lies beyond that: an edge that leads towards the eye does not come through what is
// before it.
SHARED_FUNCTION float inkNoFurther(float extended, float end, float along, float pixel) {
  float most = along < 0.0f || along > 1.0f ? kInkExtends * pixel : 1e30f;
  return min(max(extended, end - most), end + most);
}

// Measure that is linear on the screen where a surface is flat: one over the distance, but in a parallel
// projection
// (`parallel` 1, else 0) the distance itself; and back.
SHARED_FUNCTION float inkLinear(float distance, float parallel) {
  return mix(1.0f / max(distance, 1e-30f), distance, parallel);
}

// By how much of what it may a surface lies before an edge, where it is seen just beside that; above 1 it
// hides the edge. It is either the edge's own, and then where that leads to, or may not be nearer than the
// edge. Metres along the view axis: of the edge, of where its own surface is expected, of what is seen, and
// of a pixel; `away`: from the edge, pixels.
//
// An edge may touch the surface before it, as a box's does the ground: then one of both rises gently towards
// the eye. A steep surface would lead to whatever is before it.
SHARED_FUNCTION float inkBefore(float distance, float expected, float seen, float pixel, float away) {
  float allowed = kInkTolerance * pixel, rises = abs(expected - distance);
  float own = abs(expected - seen) / (allowed + kInkSlopeTolerance * rises);
  own += max(rises / (away * pixel) - kInkRisesMost, 0.0f);
  return min((distance - seen) / allowed, own);
}

// The same of both sides of an edge, by inkBefore() at two places on either: what is far behind a surface may
// lead to it at one of them by chance. Beyond an outline there is nothing of its own, and one place is
// enough.
SHARED_FUNCTION float inkHidden(vec2 beyond, vec2 before, uint isOutline) {
  float outside = isOutline != 0u ? min(beyond.x, beyond.y) : max(beyond.x, beyond.y);
  return min(outside, max(before.x, before.y));
}

// A factor on the line's width; 0 where it is hidden. `fade`, `outer`: as InkUniforms has them.
//
// Surfaces just beside the edge tell whether something is before it: it must be so on both sides. So
// there is nothing to fight with about depths, and a line is hidden over its whole width at once.
SHARED_FUNCTION float inkFullness(InkPlace p, float sceneRadius, float fade, float outer) {
  // What is hidden comes and goes by how deep it lies, and never at once.
  float hidden = smoothstep(1.0f, 2.0f, p.hidden);
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

SHARED_END
#endif
