#version 460
// The picture: the colour pass warped by the warp pass, with bloom from the lens channel.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "final_color.shared.h"

layout(constant_id = 0) const int kGlows = 1;  // whether anything in the scene acts on the lens
layout(set = 1, binding = 0, scalar) uniform Block { FinalColorUniforms u; };
layout(set = 1, binding = 1) uniform sampler2DArray color;
layout(set = 1, binding = 2) uniform sampler2DArray warp;
layout(set = 1, binding = 3) uniform sampler2DArray depth;
layout(set = 1, binding = 4) uniform sampler2DArray blurred;

// Depth-buffer value of a point one percent behind the inflated surface.
float surfaceDepth(float distance, int layer) {
  vec4 t = VIEW_FIELD(depthToEye, layer);
  float far = 1.01 * distance;
  return (t.x - t.z * far) / (t.w * far - t.y);
}

vec4 shade(ivec2 pixel, int layer) {
  ivec3 at = ivec3(pixel, layer);
  vec4 vector = texelFetch(warp, at, 0);
  vec2 own = vec2(pixel) + 0.5;
  vec2 moved = clamp(own + vector.xy, vec2(0.5), frame.imageSize - 0.5);
  // FORMULAS 10: outside the silhouette, covered by the inflated surface only, and about to fetch something that lies
  // behind that surface: such a pixel keeps its own colour. Depths are compared as the depth buffer has them, where
  // less is farther (parallel projections included).
  float surface = surfaceDepth(vector.a, layer);
  float ownDepth = texelFetch(depth, at, 0).r;
  float movedDepth = texelFetch(depth, ivec3(ivec2(moved), layer), 0).r;
  if (u.ripple == 1 && max(ownDepth, movedDepth) < surface) moved = own;
  vec4 result = textureLod(color, vec3(moved / frame.imageSize, layer), 0.0);
  if (kGlows != 0) result.rgb += u.bloom * textureLod(blurred, vec3(own / frame.imageSize, layer), 0.0).g * result.a;
  return result;
}

#include "../../shading/image_pass.glsl"
