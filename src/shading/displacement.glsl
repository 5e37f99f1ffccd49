// From where the picture takes a pixel's colour: displaced by the warp, but for what ripple is kept off (FORMULAS 10).
// Whatever is to fit the picture takes its values from the same places.
#ifndef SCUMBLE_DISPLACEMENT_GLSL
#define SCUMBLE_DISPLACEMENT_GLSL
#include "displacement.shared.h"
#include "frame.glsl"

// A pixel takes the mean of several colours, since the vector is another in each part of it.
const int kPlaces = 4;
struct Places {
  vec2 at[kPlaces];  // pixels; values there are interpolated
  bvec4 isBehind;    // instead: what lies behind the pixel itself; with layers only
};

// The depth-buffer value of a distance.
float depthOf(float distance, int layer) {
  vec4 t = VIEW_FIELD(depthToEye, layer);
  return (t.x - t.z * distance) / (t.w * distance - t.y);
}

// The pixel itself.
Places undisplaced(ivec2 pixel) {
  Places places;
  for (int i = 0; i < kPlaces; ++i) places.at[i] = vec2(pixel) + 0.5;
  places.isBehind = bvec4(false);
  return places;
}

// `warp`, interpolated: vectors; `inflated`, `depth`: the depth buffers of inflated and of other surfaces; `behindDepth`:
// of what lies behind, where ripple is layered, else anything.
Places displaced(Displacement knobs, int ripple, sampler2DArray warp, sampler2DArray inflated, sampler2DArray depth,
                 sampler2DArray behindDepth, ivec2 pixel, int layer) {
  ivec3 at = ivec3(pixel, layer);
  vec2 own = vec2(pixel) + 0.5, corner = 1.0 / frame.imageSize;
  Places places = undisplaced(pixel);
  float surface = texelFetch(inflated, at, 0).r;
  float ownDepth = texelFetch(depth, at, 0).r;
  // Depths are compared as the depth buffer has them, where less is farther (parallel projections included) and planes
  // are linear on the screen. There is a percent of tolerance, and what the inflated surface rises or falls on the way:
  // its slope, by the gentler side, so that steps to other surfaces do not count.
  vec4 before = textureGather(inflated, vec3(vec2(pixel) * corner, layer), 0);
  vec4 after = textureGather(inflated, vec3(vec2(pixel + 1) * corner, layer), 0);
  vec4 around = abs(vec4(before.x, after.z, before.z, after.x) - surface);
  float slope = min(around.x, around.y) + min(around.z, around.w);
  float distance = eyeDepth(surface, layer), beyond = depthOf(1.01 * distance, layer);
  // FORMULAS 10: outside the silhouette, covered by the inflated surface only, and about to fetch something that lies
  // behind that surface: such a pixel keeps its own colour. At a round silhouette the inflated surface stands before
  // the object by up to twice what it falls over the inflation (a sphere's does); more than 15 percent of the distance
  // is another thing.
  float fall = min(2.0 * slope * knobs.inflation, surface - depthOf(1.15 * distance, layer));
  bool outside = ownDepth + fall < beyond;
  float nearer = depthOf(0.97 * distance, layer);

  // Where nothing is torn, what is beside it does not tear it.
  vec2 ownVector = texelFetch(warp, at, 0).rg;
  bool stays = surface <= 0.0 || (ownVector.x == 0.0 && ownVector.y == 0.0);

  // A tear has no detail finer than this, which would be a comb of single pixels: vectors are means over a square, and
  // those of the parts of a pixel lie between its corners.
  float reach = max(0.75 * frame.pixelScale, 0.25), inner = 0.5 + 0.125 / reach;
  vec2 corners[4];
  for (int i = 0; i < 4; ++i) {
    vec2 side = vec2((i & 1) * 2 - 1, (i >> 1) * 2 - 1);
    corners[i] = textureLod(warp, vec3((own + reach * side) * corner, layer), 0.0).rg;
  }
  for (int i = 0; i < kPlaces; ++i) {
    vec2 share = vec2((i & 1) != 0 ? inner : 1.0 - inner, (i >> 1) != 0 ? inner : 1.0 - inner);
    vec2 vector = mix(mix(corners[0], corners[1], share.x), mix(corners[2], corners[3], share.x), share.y);
    if (stays) vector = vec2(0.0);
    vec2 moved = clamp(own + vector, vec2(0.5), frame.imageSize - 0.5);
    float movedDepth = texelFetch(depth, ivec3(ivec2(moved), layer), 0).r;
    if (ripple != kRipplePaper && surface > 0.0) {
      float rise = slope * (length(vector) + 1.5);  // pixels are whole, vectors are not
      if (outside && movedDepth + fall < beyond) moved = own;
      // About to fetch something before the surface that covers this pixel: what is there, inflated, does not reach here.
      if (movedDepth > nearer + rise) moved = own;
      // Torn off: the object's own pixel, and a sample from outside the silhouette. What lies behind the pixel shows
      // instead, if that is what the sample shows a piece of: inside a fold there is nothing behind but the rest of the
      // world.
      if (ripple == kRippleLayered && !outside && movedDepth + rise < beyond) {
        float there = texelFetch(inflated, ivec3(ivec2(moved), layer), 0).r;
        bool beside = there == 0.0 || movedDepth < depthOf(1.15 * eyeDepth(there, layer), layer);
        places.isBehind[i] = beside && texelFetch(behindDepth, at, 0).r >= 0.8 * movedDepth;
      }
    }
    places.at[i] = moved;
  }
  return places;
}
#endif
