#version 460
// Colours of nearly the same value run into each other, along the vectors that tear edges: as far as a mark is wide, and
// less where those are short, so that stretches of an edge are found again.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "../../shading/oklab.glsl"
#include "lost_edges.shared.h"

layout(constant_id = 0) const int kMode = 0;  // 0: as it is; 1: colours are mixed; 2: one or the other
layout(set = 1, binding = 0, scalar) uniform Block { LostEdgesUniforms u; };
layout(set = 1, binding = kLostPicture) uniform sampler2DArray seen;
layout(set = 1, binding = kLostWarp) uniform sampler2DArray warp;

float valueOf(vec4 color) { return oklabFromLinear(color.rgb / max(color.a, 1e-3)).x; }

// How far colours run into each other, 0 to 1: the whole way up to half of the difference from which edges are found. What
// is transparent has no value.
float runs(vec4 own, float value, vec4 there) {
  if (own.rgb == there.rgb) return 1.0;
  float met = 1.0 - smoothstep(0.5 * u.values, u.values, abs(valueOf(there) - value));
  return abs(own.a - there.a) > 1.0 / 512.0 ? 0.0 : met;
}

vec4 shade(ivec2 pixel, int layer) {
  vec4 own = texelFetch(seen, ivec3(pixel, layer), 0);
  if (kMode == 0) return own;
  vec2 vector = texelFetch(warp, ivec3(pixel, layer), 0).rg;
  float tear = length(vector), reach = u.width * min(tear / u.wholeTear, 1.0);
  if (reach < 0.5) return own;
  vec2 way = vector * (reach / tear), middle = vec2(pixel) + 0.5;
  float value = valueOf(own);
  if (kMode == 2) {
    // No colours but those that the palette has.
    vec4 there = texelFetch(seen, ivec3(clamp(ivec2(middle + way), ivec2(0), ivec2(frame.imageSize) - 1), layer), 0);
    return u.amount * runs(own, value, there) >= 0.5 ? there : own;
  }
  vec4 sum = own;
  float weights = 1.0;
  for (int side = -1; side <= 1; side += 2) {
    // What has been found on the way hides what comes behind it.
    float open = u.amount;
    for (int i = 1; i <= kLostSteps; ++i) {
      vec2 at = middle + way * (float(side * i) / float(kLostSteps));
      vec4 there = textureLod(seen, vec3(at / frame.imageSize, layer), 0.0);
      open *= runs(own, value, there);
      sum += open * there;
      weights += open;
    }
  }
  return sum / weights;
}

#define SHADES_TILES
#include "../../shading/image_pass.glsl"
