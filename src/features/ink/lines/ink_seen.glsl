// How full a line is at a place on its edge, by the depths beside it.
#ifndef SCUMBLE_INK_SEEN_GLSL
#define SCUMBLE_INK_SEEN_GLSL
#include "../../../shading/frame.glsl"
#include "../fullness.shared.h"

layout(set = 2, binding = kInkDepth) uniform sampler2DArray depth;

// An edge on the screen.
struct InkSpine {
  vec4 ends;     // pixels
  vec2 depths;   // depth-buffer values at both
  vec2 outward;  // away from the form
  vec4 slopes;   // as LineRecord has them
  vec2 turn, reach;
  bool isOutline;
  uint seen;  // as LineRecord has it
};

// What is seen so many pixels beyond an edge, or before it where that is below 0: how far away it is, and inkBefore().
vec2 besideAt(float away, InkSpine s, vec2 spine, float distance, float pixel, int view) {
  vec2 slope = away > 0.0 ? s.slopes.zw : s.slopes.xy, place = spine + away * s.outward;
  float parallel = VIEW_FIELD(orthographic, view);
  vec2 at = floor(clamp(place, vec2(0.0), frame.imageSize - 1.0));
  float seen = eyeDepth(texelFetch(depth, ivec3(at, view), 0).r, view);
  float expected = inkLinear(inkLinear(distance, parallel) + dot(slope, at + ink.depthAt - spine), parallel);
  return vec2(seen, inkBefore(distance, expected, seen, pixel, abs(away)));
}

float fullnessAt(InkSpine s, float t, float size, float radius, int view) {
  vec2 place = mix(s.ends.xy, s.ends.zw, t);
  InkPlace p;
  float end = eyeDepth(mix(s.depths.x, s.depths.y, clamp(t, 0.0, 1.0)), view);
  p.pixel = metresOfPixel(end, view);
  p.distance = inkNoFurther(eyeDepth(inkDepthAlong(s.depths.x, s.depths.y, t), view), end, t, p.pixel);
  vec2 beyond = besideAt(kInkBeyond, s, place, p.distance, p.pixel, view),
       farther = besideAt(kInkFarBeyond, s, place, p.distance, p.pixel, view),
       before = besideAt(-kInkBefore, s, place, p.distance, p.pixel, view),
       inside = besideAt(-kInkFarBefore, s, place, p.distance, p.pixel, view);
  p.beyond = max(beyond.x, farther.x);
  p.radius = radius;
  p.turn = s.turn;
  p.reach = inkReach(t, s.reach, size);
  p.isOutline = s.isOutline ? 1u : 0u;
  p.hidden = inkHidden(vec2(beyond.y, farther.y), vec2(before.y, inside.y), p.isOutline);
  return inkSeen(t, s.seen) * inkFullness(p, frame.sceneRadius, ink.fade, ink.outer);
}

// `t`: along it, 0 to 1; `radius`: of the line, pixels.
float meanFullnessAt(InkSpine s, float t, float radius, int view) {
  float size = max(distance(s.ends.xy, s.ends.zw), 1e-3), sum = 0.0;
  for (int i = -1; i <= 1; ++i) sum += fullnessAt(s, t + float(i) * kInkMeanOver / size, size, radius, view);
  return sum / 3.0;
}
#endif
