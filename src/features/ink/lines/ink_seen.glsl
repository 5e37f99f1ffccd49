// How full a line is at a place on its edge, by the depths beside it.
#ifndef SCUMBLE_INK_SEEN_GLSL
#define SCUMBLE_INK_SEEN_GLSL
#include "../../../shading/frame.glsl"
#include "../fullness.shared.h"

layout(set = 2, binding = kInkDepth) uniform sampler2DArray depth;

float depthAt(vec2 place, int view) {
  return texelFetch(depth, ivec3(clamp(place, vec2(0.0), frame.imageSize - 1.0), view), 0).r;
}

// `own`: the place's depth-buffer value; `outward`: on the screen, away from the form; `turn`: as LineRecord has it;
// `radius`: of the line, pixels.
float fullnessAt(vec2 place, float own, vec2 outward, bool isOutline, vec2 turn, float radius, int view) {
  InkPlace p;
  p.distance = eyeDepth(own, view);
  p.beyond = eyeDepth(min(depthAt(place + kInkBeyond * outward, view), depthAt(place + kInkFarBeyond * outward, view)), view);
  p.before = eyeDepth(depthAt(place - kInkBefore * outward, view), view);
  p.pixel = metresOfPixel(p.distance, view);
  p.radius = radius;
  p.turn = turn;
  p.isOutline = isOutline ? 1u : 0u;
  return inkFullness(p, frame.sceneRadius, VIEW_FIELD(orthographic, view), ink.fade, ink.outer);
}
#endif
