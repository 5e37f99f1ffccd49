#version 460
// The picture: the colour pass warped by the warp pass, with bloom from the lens channel.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "final_color.shared.h"

layout(constant_id = 0) const int kGlows = 1;    // whether anything in the scene acts on the lens
layout(constant_id = 1) const int kLayered = 0;  // whether there is a colour of what lies behind
layout(set = 1, binding = 0, scalar) uniform Block { FinalColorUniforms u; };
layout(set = 1, binding = 1) uniform sampler2DArray color;
layout(set = 1, binding = 2) uniform sampler2DArray warp;
layout(set = 1, binding = 3) uniform sampler2DArray depth;
layout(set = 1, binding = 4) uniform sampler2DArray blurred;
layout(set = 1, binding = 5) uniform sampler2DArray behind;
layout(set = 1, binding = 6) uniform sampler2DArray behindDepth;

// Depth-buffer values of distances.
vec4 depthsOf(vec4 distance, int layer) {
  vec4 t = VIEW_FIELD(depthToEye, layer);
  return (t.x - t.z * distance) / (t.w * distance - t.y);
}
float depthOf(float distance, int layer) { return depthsOf(vec4(distance), layer).x; }

vec4 shade(ivec2 pixel, int layer) {
  ivec3 at = ivec3(pixel, layer);
  vec4 vector = texelFetch(warp, at, 0);
  vec2 own = vec2(pixel) + 0.5;
  vec2 moved = clamp(own + vector.xy, vec2(0.5), frame.imageSize - 0.5);
  float ownDepth = texelFetch(depth, at, 0).r;
  float movedDepth = texelFetch(depth, ivec3(ivec2(moved), layer), 0).r;
  // Depths are compared as the depth buffer has them, where less is farther (parallel projections included) and planes
  // are linear on the screen. There is a percent of tolerance, and what the inflated surface rises or falls on the way:
  // its slope, by the gentler side, so that steps to other surfaces do not count.
  vec2 corner = 1.0 / frame.imageSize;
  vec4 before = textureGather(warp, vec3(vec2(pixel) * corner, layer), 3);
  vec4 after = textureGather(warp, vec3(vec2(pixel + 1) * corner, layer), 3);
  vec4 around = abs(depthsOf(vec4(before.x, after.z, before.z, after.x), layer) - depthOf(vector.a, layer));
  float slope = min(around.x, around.y) + min(around.z, around.w);
  float beyond = depthOf(1.01 * vector.a, layer);
  bool revealed = false;
  if (u.ripple > 0 && vector.a > 0.0) {
    float rise = slope * (length(vector.xy) + 1.5);  // pixels are whole, vectors are not
    // FORMULAS 10: outside the silhouette, covered by the inflated surface only, and about to fetch something that lies
    // behind that surface: such a pixel keeps its own colour. At a round silhouette the inflated surface stands before
    // the object by up to twice what it falls over the inflation (a sphere's does); more than 15 percent of the
    // distance is another thing.
    float fall = min(2.0 * slope * u.inflation, depthOf(vector.a, layer) - depthOf(1.15 * vector.a, layer));
    bool outside = ownDepth + fall < beyond;
    if (outside && movedDepth + fall < beyond) moved = own;
    // About to fetch something before the surface that covers this pixel: what is there, inflated, does not reach here.
    if (movedDepth > depthOf(0.97 * vector.a, layer) + rise) moved = own;
    // Torn off: the object's own pixel, and a sample from outside the silhouette. What lies behind the pixel shows
    // instead, if that is what the sample shows a piece of: inside a fold there is nothing behind but the rest of the
    // world.
    if (kLayered != 0 && !outside && movedDepth + rise < beyond) {
      float there = texelFetch(warp, ivec3(ivec2(moved), layer), 0).a;
      bool beside = there == 0.0 || movedDepth < depthOf(1.15 * there, layer);
      revealed = beside && texelFetch(behindDepth, at, 0).r >= 0.8 * movedDepth;
    }
  }
  vec4 result = textureLod(color, vec3(moved / frame.imageSize, layer), 0.0);
  if (kLayered != 0 && revealed) result = texelFetch(behind, at, 0);
  if (kGlows != 0) result.rgb += u.bloom * textureLod(blurred, vec3(own / frame.imageSize, layer), 0.0).g * result.a;
  return result;
}

#include "../../shading/image_pass.glsl"
