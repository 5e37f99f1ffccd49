#version 460
// The picture: the colour pass warped by the warp pass, with bloom from the lens channel.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_multiview : require
#include "../../shading/frame.glsl"
#include "final_color.shared.h"

layout(set = 1, binding = 0, scalar) uniform Block { FinalColorUniforms u; };
layout(set = 1, binding = 1) uniform sampler2DArray color;
layout(set = 1, binding = 2) uniform sampler2DArray warp;
layout(set = 1, binding = 3) uniform sampler2DArray depth;
layout(set = 1, binding = 4) uniform sampler2DArray blurred;

vec4 shade(ivec2 pixel, int layer) {
  ivec3 at = ivec3(pixel, layer);
  vec4 vector = texelFetch(warp, at, 0);
  vec2 source = vec2(pixel) + 0.5;
  if (vector.b > 0.0) {
    vec2 moved = clamp(source + vector.xy, vec2(0.5), frame.imageSize - 0.5);
    bool keeps = false;
    if (u.ripple == 1) {
      // FORMULAS 10: outside the silhouette, covered by the inflated surface only, and about to fetch something that
      // lies behind that surface: such a pixel keeps its own colour.
      float surface = vector.a * 1.01;
      float own = eyeDepth(texelFetch(depth, at, 0).r, layer);
      float there = eyeDepth(texelFetch(depth, ivec3(ivec2(moved), layer), 0).r, layer);
      keeps = own > surface && there > surface;
    }
    if (!keeps) source = moved;
  }
  vec4 result = textureLod(color, vec3(source / frame.imageSize, layer), 0.0);
  float glow = textureLod(blurred, vec3((vec2(pixel) + 0.5) / frame.imageSize, layer), 0.0).g;
  result.rgb += u.bloom * glow * result.a;
  return result;
}

#include "../../shading/image_pass.glsl"
