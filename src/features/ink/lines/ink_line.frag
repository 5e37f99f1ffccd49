#version 460
// Ink of a line, where the edge is seen.
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/frame.glsl"
#include "../../../shading/view_index.glsl"
#include "../ink_choices.glsl"
#include "../ink_coverage.glsl"

layout(set = 1, binding = kInkBlock, scalar) uniform Ink { InkUniforms ink; };
#include "ink_seen.glsl"
layout(set = 2, binding = kInkShadowed) uniform sampler2DArray shadowed;

layout(location = 0) flat in vec4 inSpine;
layout(location = 1) flat in vec4 inShift;
layout(location = 2) flat in vec4 inRadii;
layout(location = 3) flat in vec4 inColor;
layout(location = 4) flat in vec3 inOutward;
layout(location = 5) flat in vec2 inTurn;

layout(location = 0) out vec4 outInk;

// How far outlines reach into the form, pixels: two anti-aliased edges that only touch would leave a light seam, and so
// would two that are torn apart.
float overlap() { return max(0.75, 2.4 * frame.pixelScale); }
// How far along a line is nearest, from 0 to 1.
float nearestOn(vec2 from, vec2 to, vec2 point) {
  vec2 along = to - from;
  return clamp(dot(point - from, along) / max(dot(along, along), 1e-12), 0.0, 1.0);
}

void main() {
  int view = viewIndex();
  vec2 pixel = gl_FragCoord.xy;
  float t = nearestOn(inSpine.xy, inSpine.zw, pixel);
  float radius = mix(inRadii.x, inRadii.y, t);

  vec2 outward = inOutward.xy;
  vec2 spine = mix(inSpine.xy, inSpine.zw, t);
  radius *= fullnessAt(spine, mix(inRadii.z, inRadii.w, t), outward, inOutward.z > 0.0, inTurn, radius, view);

  float moved = ink.offset * frame.pixelScale + (kPlacement == kInkExterior ? max(radius - overlap(), 0.0) : 0.0);
  vec4 line = inSpine + inShift * moved;
  float away = distance(pixel, mix(line.xy, line.zw, nearestOn(line.xy, line.zw, pixel)));
  float coverage = coverageOf(radius, away);
  if (kDoubled && inOutward.z > 0.0) {
    line = inSpine + inShift * (moved + ink.doubled * frame.pixelScale);
    away = distance(pixel, mix(line.xy, line.zw, nearestOn(line.xy, line.zw, pixel)));
    coverage = max(coverage, coverageOf(radius * ink.doubledWidth, away));
  }
  if (coverage <= 0.0) discard;
  vec3 color = inColor.rgb;
  if (inColor.a != 0.0) {
    vec2 inside = clamp(spine - 2.0 * outward, vec2(0.0), frame.imageSize - 1.0);
    vec4 surface = texelFetch(shadowed, ivec3(inside, view), 0);
    if (surface.a > 0.0) color = mix(color, (inColor.a > 0.0 ? vec3(0.6) : color) * surface.rgb / surface.a, abs(inColor.a));
  }
  outInk = coverage * vec4(1.0 - color, 1.0);
}
