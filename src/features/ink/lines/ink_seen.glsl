// How full a line is at a place on its edge, by the depths beside it.
#ifndef SCUMBLE_INK_SEEN_GLSL
#define SCUMBLE_INK_SEEN_GLSL
#include "../../../shading/frame.glsl"
#include "../fullness.shared.h"

layout(set = 2, binding = kInkDepth) uniform sampler2DArray depth;

float depthAt(vec2 place, int view) {
  return texelFetch(depth, ivec3(clamp(place, vec2(0.0), frame.imageSize - 1.0), view), 0).r;
}

// An edge on the screen.
struct InkSpine {
  vec4 ends;     // pixels
  vec2 depths;   // depth-buffer values at both
  vec2 outward;  // away from the form
  vec2 turn, reach;  // as LineRecord has them
  bool isOutline, isValley;
  uint seen;  // as LineRecord has it
};

float fullnessAt(InkSpine s, float t, float size, float radius, int view) {
  vec2 place = mix(s.ends.xy, s.ends.zw, t);
  InkPlace p;
  p.distance = eyeDepth(inkDepthAlong(s.depths.x, s.depths.y, t), view);
  p.beyond = eyeDepth(min(depthAt(place + kInkBeyond * s.outward, view), depthAt(place + kInkFarBeyond * s.outward, view)), view);
  p.before = eyeDepth(depthAt(place - kInkBefore * s.outward, view), view);
  p.pixel = metresOfPixel(p.distance, view);
  p.radius = radius;
  p.turn = s.turn;
  p.reach = inkReach(t, s.reach, size);
  p.isOutline = s.isOutline ? 1u : 0u;
  p.isValley = s.isValley ? 1u : 0u;
  return inkSeen(t, s.seen) * inkFullness(p, frame.sceneRadius, VIEW_FIELD(orthographic, view), ink.fade, ink.outer);
}

// `t`: along it, 0 to 1; `radius`: of the line, pixels.
float meanFullnessAt(InkSpine s, float t, float radius, int view) {
  float size = max(distance(s.ends.xy, s.ends.zw), 1e-3), sum = 0.0;
  for (int i = -1; i <= 1; ++i) sum += fullnessAt(s, t + float(i) * kInkMeanOver / size, size, radius, view);
  return sum / 3.0;
}
#endif
