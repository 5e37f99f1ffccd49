#version 460
// Ink of a line, where the edge is seen.
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/frame.glsl"
#include "../../../shading/view_index.glsl"
#include "../ink.shared.h"

layout(set = 1, binding = kInkBlock, scalar) uniform Ink { InkUniforms ink; };
layout(set = 2, binding = kInkDepth) uniform sampler2DArray depth;
layout(set = 2, binding = kInkShadowed) uniform sampler2DArray shadowed;

layout(location = 0) flat in vec4 inSpine;
layout(location = 1) flat in vec4 inShift;
layout(location = 2) flat in vec4 inRadii;
layout(location = 3) flat in vec4 inColor;
layout(location = 4) flat in vec3 inOutward;

layout(location = 0) out vec4 outInk;

// How far outlines reach into the form, pixels: two anti-aliased edges that only touch would leave a light seam.
const float kOverlap = 0.75;
// By how much a depth-buffer value may be greater than an edge's own before it hides it: what rounding does, and what
// levels of detail leave out.
const float kTolerance = 1.0015;

float depthAt(vec2 place, int view) {
  return texelFetch(depth, ivec3(clamp(place, vec2(0.0), frame.imageSize - 1.0), view), 0).r;
}

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

  // Where the edge itself is, is it hidden? What lies just beside it on both sides tells: if the farther of the two is
  // nearer than the edge, something is before it. So there is nothing to fight with about depths, and a line is hidden
  // over its whole width at once.
  vec2 spine = mix(inSpine.xy, inSpine.zw, t), outward = inOutward.xy;
  float own = mix(inRadii.z, inRadii.w, t), ownDistance = eyeDepth(own, view);
  float beyond = min(depthAt(spine + 1.5 * outward, view), depthAt(spine + 2.6 * outward, view));
  float farthest = min(beyond, depthAt(spine - 1.5 * outward, view));
  if (farthest > own * kTolerance) discard;
  if (inOutward.z > 0.0) {
    // An outline tapers where the form goes on right behind it, so that it neither begins nor ends at once.
    float behind = min(eyeDepth(beyond, view), 1e6 * ownDistance) - ownDistance;
    float metresOfPixel = abs(VIEW_FIELD(ndcToEyeRay, view).y) * 2.0 / frame.imageSize.y *
                          (VIEW_FIELD(orthographic, view) != 0.0 ? 1.0 : ownDistance);
    float full = 2.0 * ink.fade * max(radius, 0.5) * metresOfPixel;
    radius *= mix(1.0, ink.outer, smoothstep(0.1, 0.4, behind / frame.sceneRadius));
    if (full > 0.0) radius *= smoothstep(0.0, 1.0, behind / full);
  }

  float moved = ink.offset * frame.pixelScale + (ink.placement == kInkExterior ? max(radius - kOverlap, 0.0) : 0.0);
  vec4 line = inSpine + inShift * moved;
  float away = distance(pixel, mix(line.xy, line.zw, nearestOn(line.xy, line.zw, pixel)));
  float drawn = max(radius, 0.5);  // thinner lines are lighter instead
  float coverage = radius / drawn * clamp(drawn - away + 0.5, 0.0, 1.0);
  if (coverage <= 0.0) discard;
  vec3 color = inColor.rgb;
  if (inColor.a > 0.0) {
    vec2 inside = clamp(spine - 2.0 * outward, vec2(0.0), frame.imageSize - 1.0);
    vec4 surface = texelFetch(shadowed, ivec3(inside, view), 0);
    if (surface.a > 0.0) color = mix(color, 0.6 * surface.rgb / surface.a, inColor.a);
  }
  outInk = coverage * vec4(1.0 - color, 1.0);
}
