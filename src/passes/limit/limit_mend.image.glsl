#version 460
// Anti-aliased edges, once colours are limited. A pixel on the edge between two things has a colour of its own between
// theirs, and the palette's nearest to it may be a third one, which would draw a line around everything. Here such a pixel
// becomes the same mixture of what became of its neighbours.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "limit.shared.h"

layout(constant_id = 0) const int kMends = 1;
layout(set = 1, binding = kMendColor) uniform sampler2DArray color;
layout(set = 1, binding = kMendLimited) uniform sampler2DArray limited;

// Square root of a pixel's straight colour: about as far apart as the eye sees colours.
vec3 rootAt(sampler2DArray source, ivec2 pixel, int layer) {
  vec4 straight = texelFetch(source, ivec3(pixel, layer), 0);
  return sqrt(max(straight.rgb, 0.0) * (1.0 / max(straight.a, 1e-3)));
}

vec4 shade(ivec2 pixel, int layer) {
  vec4 own = texelFetch(limited, ivec3(pixel, layer), 0);
  if (kMends == 0) return own;
  ivec2 last = ivec2(frame.imageSize) - 1;
  ivec2 left = max(pixel - ivec2(1, 0), ivec2(0)), right = min(pixel + ivec2(1, 0), last);
  ivec2 above = max(pixel - ivec2(0, 1), ivec2(0)), below = min(pixel + ivec2(0, 1), last);

  // Across the edge.
  vec3 a = rootAt(color, left, layer), b = rootAt(color, right, layer);
  vec3 c = rootAt(color, above, layer), d = rootAt(color, below, layer);
  bool upright = dot(d - c, d - c) > dot(b - a, b - a);
  vec3 from = upright ? c : a, way = upright ? d - c : b - a;
  float squared = dot(way, way);

  // How far the pixel is on the way from one neighbour to the other, and whether it is on that way at all.
  vec3 toOwn = rootAt(color, pixel, layer) - from;
  float part = clamp(dot(toOwn, way) / max(squared, 1e-6), 0.0, 1.0);
  vec3 off = toOwn - part * way;
  float mends = smoothstep(0.06, 0.10, sqrt(squared)) * (1.0 - smoothstep(0.01, 0.04, dot(off, off) / max(squared, 1e-6)));

  vec3 root = mix(rootAt(limited, upright ? above : left, layer), rootAt(limited, upright ? below : right, layer), part);
  return vec4(mix(own.rgb, root * root * own.a, mends), own.a);
}

#include "../../shading/image_pass.glsl"
