// From where the picture takes a pixel's colour: displaced by the warp, but for what ripple is kept off (FORMULAS 10).
// Whatever is to fit the picture takes its values from the same place.
#ifndef SCUMBLE_DISPLACEMENT_GLSL
#define SCUMBLE_DISPLACEMENT_GLSL
#include "displacement.shared.h"
#include "frame.glsl"

struct Place {
  vec2 at;        // pixels; values there are interpolated
  bool isBehind;  // instead: what lies behind the pixel itself; with layers only
};

// Depth-buffer values of distances.
vec4 depthsOf(vec4 distance, int layer) {
  vec4 t = VIEW_FIELD(depthToEye, layer);
  return (t.x - t.z * distance) / (t.w * distance - t.y);
}
float depthOf(float distance, int layer) { return depthsOf(vec4(distance), layer).x; }

// `warp`, `depth`: the slots; `behindDepth`: of what lies behind, where ripple is layered, else anything.
Place displaced(Displacement knobs, int ripple, sampler2DArray warp, sampler2DArray depth, sampler2DArray behindDepth,
                ivec2 pixel, int layer) {
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
  if (ripple != kRipplePaper && vector.a > 0.0) {
    float rise = slope * (length(vector.xy) + 1.5);  // pixels are whole, vectors are not
    // FORMULAS 10: outside the silhouette, covered by the inflated surface only, and about to fetch something that lies
    // behind that surface: such a pixel keeps its own colour. At a round silhouette the inflated surface stands before
    // the object by up to twice what it falls over the inflation (a sphere's does); more than 15 percent of the
    // distance is another thing.
    float fall = min(2.0 * slope * knobs.inflation, depthOf(vector.a, layer) - depthOf(1.15 * vector.a, layer));
    bool outside = ownDepth + fall < beyond;
    if (outside && movedDepth + fall < beyond) moved = own;
    // About to fetch something before the surface that covers this pixel: what is there, inflated, does not reach here.
    if (movedDepth > depthOf(0.97 * vector.a, layer) + rise) moved = own;
    // Torn off: the object's own pixel, and a sample from outside the silhouette. What lies behind the pixel shows
    // instead, if that is what the sample shows a piece of: inside a fold there is nothing behind but the rest of the
    // world.
    if (ripple == kRippleLayered && !outside && movedDepth + rise < beyond) {
      float there = texelFetch(warp, ivec3(ivec2(moved), layer), 0).a;
      bool beside = there == 0.0 || movedDepth < depthOf(1.15 * there, layer);
      revealed = beside && texelFetch(behindDepth, at, 0).r >= 0.8 * movedDepth;
    }
  }
  return Place(moved, revealed);
}
#endif
