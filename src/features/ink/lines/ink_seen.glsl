// Whether a place on an edge is seen, and how full its line is there.
#ifndef SCUMBLE_INK_SEEN_GLSL
#define SCUMBLE_INK_SEEN_GLSL
#include "../../../shading/frame.glsl"

layout(set = 2, binding = kInkDepth) uniform sampler2DArray depth;

// By how much something may be before an edge and hide nothing, as a part of its distance, or (in parallel projections) of
// the scene's radius: what rounding does, and what levels of detail leave out.
const float kTolerance = 0.0015;

float depthAt(vec2 place, int view) {
  return texelFetch(depth, ivec3(clamp(place, vec2(0.0), frame.imageSize - 1.0), view), 0).r;
}

// A factor on the line's width; 0 where it is hidden. `own`: the place's depth-buffer value; `outward`: on the screen, away
// from the form; `turn`: as LineRecord has it; `radius`: of the line, pixels.
//
// What lies just beside the edge on both sides tells whether something is before it: if the farther of the two is nearer
// than the edge. So there is nothing to fight with about depths, and a line is hidden over its whole width at once.
float fullnessAt(vec2 place, float own, vec2 outward, bool isOutline, vec2 turn, float radius, int view) {
  float beyond = min(depthAt(place + 1.5 * outward, view), depthAt(place + 2.6 * outward, view));
  float parallel = VIEW_FIELD(orthographic, view);  // mixed and not chosen by: no branch on a uniform
  float distance = eyeDepth(own, view);
  float pixel = metresOfPixel(distance, view);
  // On both sides of an inner line in a valley the surface comes nearer, also of one that is an outline and stands on
  // something.
  float tolerance = kTolerance * mix(distance, frame.sceneRadius, parallel) +
                    (isOutline && turn.y <= 0.0 ? 0.0 : 3.0 * pixel);
  if (eyeDepth(min(beyond, depthAt(place - 1.5 * outward, view)), view) < distance - tolerance) return 0.0;
  if (!isOutline) return 1.0;
  // An outline tapers where the form goes on right behind it, so that it neither begins nor ends at once; but the fold of a
  // coarse form has depth until it closes, and tapers by its angle.
  float behind = min(eyeDepth(beyond, view), 1e6 * distance) - distance;
  float full = 2.0 * ink.fade * max(radius, 0.5) * pixel, far = behind / frame.sceneRadius;
  float fullness = mix(1.0, ink.outer, smoothstep(0.1, 0.4, far)) * smoothstep(0.0, 1.0, behind / max(full, 1e-20));
  return max(fullness * mix(turn.x, 1.0, smoothstep(0.05, 0.2, far)), turn.y);
}
#endif
