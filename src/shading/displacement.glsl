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
  vec4 depths;       // depth-buffer values of single samples there; where those are looked for
};

#ifdef MULTISAMPLED
// Where samples lie in a pixel, each in a quarter of its own.
const vec2 kSamplePlaces[kPlaces] = vec2[](vec2(0.375, 0.125), vec2(0.875, 0.375), vec2(0.125, 0.625), vec2(0.625, 0.875));

// The sample that is nearest to a place in its pixel.
int sampleAt(vec2 place) {
  vec2 part = fract(place);
  return int(part.x >= 0.5) + 2 * int(part.y >= 0.5);
}

// The pixel's own samples.
Places ownSamples(ivec2 pixel) {
  Places places;
  for (int i = 0; i < kPlaces; ++i) places.at[i] = vec2(pixel) + kSamplePlaces[i];
  places.isBehind = bvec4(false);
  return places;
}
#endif

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

// What the warp and the inflated surface say of a pixel.
struct Tear {
  float surface;   // depth of the inflated surface
  float slope;     // how much that rises or falls a pixel
  float fall;      // by how much it may lie before the object itself
  float beyond;    // what is farther is behind it
  float nearer;    // what is not is before it
  bool stays;      // nothing is torn
  vec2 corners[4];  // vectors at the corners of a square around the pixel's middle, upper left first
  float reach;      // of those, pixels
};

Tear tearOf(Displacement knobs, sampler2DArray warp, sampler2DArray inflated, ivec3 at) {
  Tear tear;
  vec2 own = vec2(at.xy) + 0.5, corner = 1.0 / frame.imageSize;
  // What is at the pixel itself is among the four around its upper left corner.
  vec4 before = textureGather(inflated, vec3(vec2(at.xy) * corner, at.z), 0);
  vec4 after = textureGather(inflated, vec3(vec2(at.xy + 1) * corner, at.z), 0);
  tear.surface = before.y;
  // Depths are compared as the depth buffer has them, where less is farther (parallel projections included) and planes
  // are linear on the screen. There is a percent of tolerance, and what the inflated surface rises or falls on the way:
  // its slope, by the gentler side, so that steps to other surfaces do not count.
  vec4 around = abs(vec4(before.x, after.z, before.z, after.x) - tear.surface);
  tear.slope = min(around.x, around.y) + min(around.z, around.w);
  float distance = eyeDepth(tear.surface, at.z);
  tear.beyond = depthOf(1.01 * distance, at.z);
  // FORMULAS 10: outside the silhouette, covered by the inflated surface only, and about to fetch something that lies
  // behind that surface: what is there keeps its own colour. At a round silhouette the inflated surface stands before
  // the object by up to twice what it falls over the inflation (a sphere's does); more than 15 percent of the distance
  // is another thing.
  tear.fall = min(2.0 * tear.slope * knobs.inflation, tear.surface - depthOf(1.15 * distance, at.z));
  tear.nearer = depthOf(0.97 * distance, at.z);
  // Where nothing is torn, what is beside it does not tear it.
  vec2 ownVector = texelFetch(warp, at, 0).rg;
  tear.stays = tear.surface <= 0.0 || (ownVector.x == 0.0 && ownVector.y == 0.0);
  // A tear has no detail finer than this, which would be a comb of single pixels: vectors are means over a square, and
  // those of the parts of a pixel lie between its corners.
  tear.reach = max(0.75 * frame.pixelScale, 0.25);
  for (int i = 0; i < 4; ++i) {
    vec2 side = vec2((i & 1) * 2 - 1, (i >> 1) * 2 - 1);
    tear.corners[i] = textureLod(warp, vec3((own + tear.reach * side) * corner, at.z), 0.0).rg;
  }
  return tear;
}

// `offset`: from the pixel's middle.
vec2 vectorAt(Tear tear, vec2 offset) {
  vec2 share = 0.5 + 0.5 * offset / tear.reach;
  return mix(mix(tear.corners[0], tear.corners[1], share.x), mix(tear.corners[2], tear.corners[3], share.x), share.y);
}

float riseOf(Tear tear, vec2 vector) {
  return tear.slope * (length(vector) + 1.5);  // pixels are whole, vectors are not
}

// The nearest depth among those of a pixel and its neighbours, but for two at corners.
float nearestAround(sampler2DArray depth, ivec3 at) {
  vec2 corner = 1.0 / frame.imageSize;
  vec4 near = max(textureGather(depth, vec3(vec2(at.xy) * corner, at.z), 0),
                  textureGather(depth, vec3(vec2(at.xy + 1) * corner, at.z), 0));
  return max(max(near.x, near.y), max(near.z, near.w));
}

// Torn off: the object's own, and a sample from outside the silhouette. What lies behind the pixel shows instead, if that
// is what the sample shows a piece of: inside a fold there is nothing behind but the rest of the world.
bool isBeside(sampler2DArray inflated, vec2 moved, float sampled, int layer) {
  float there = texelFetch(inflated, ivec3(moved, layer), 0).r;
  return there == 0.0 || sampled < depthOf(1.15 * eyeDepth(there, layer), layer);
}

// `warp`, interpolated: vectors; `inflated`, `depth`: the depth buffers of inflated and of other surfaces; `behindDepth`:
// of what lies behind, where ripple is layered, else anything. `mixes`: colours of pixels at a silhouette are those of
// several samples, of which the depth is one's.
Places displaced(Displacement knobs, int ripple, bool mixes, sampler2DArray warp, sampler2DArray inflated,
                 sampler2DArray depth, sampler2DArray behindDepth, ivec2 pixel, int layer) {
  ivec3 at = ivec3(pixel, layer);
  vec2 own = vec2(pixel) + 0.5, corner = 1.0 / frame.imageSize;
  Places places = undisplaced(pixel);
  Tear tear = tearOf(knobs, warp, inflated, at);
  float ownDepth = texelFetch(depth, at, 0).r;
  bool covered = ownDepth + tear.fall >= tear.beyond, outside = !covered;
  // Not where samples may have given the pixel some of the object: its own colour would leave a hairline where the edge
  // is torn off.
  if (mixes) {
    outside = nearestAround(depth, at) + tear.fall < tear.beyond;
  }
  for (int i = 0; i < kPlaces; ++i) {
    vec2 vector = tear.stays ? vec2(0.0) : vectorAt(tear, vec2((i & 1) * 2 - 1, (i >> 1) * 2 - 1) * 0.25);
    vec2 moved = clamp(own + vector, vec2(0.5), frame.imageSize - 0.5);
    // The nearest of what is mixed there.
    vec4 mixed = textureGather(depth, vec3(moved * corner, layer), 0);
    float movedDepth = max(max(mixed.x, mixed.y), max(mixed.z, mixed.w));
    if (ripple != kRipplePaper && tear.surface > 0.0) {
      float rise = riseOf(tear, vector);
      if (outside && movedDepth + tear.fall < tear.beyond) moved = own;
      // About to fetch something before the surface that covers this pixel: what is there, inflated, does not reach here.
      if (movedDepth > tear.nearer + rise) moved = own;
      vec2 part = fract(moved - 0.5);
      float sampled = part.x < 0.5 ? (part.y < 0.5 ? mixed.w : mixed.x) : (part.y < 0.5 ? mixed.z : mixed.y);
      if (ripple == kRippleLayered && covered && sampled + rise < tear.beyond)
        places.isBehind[i] = isBeside(inflated, moved, sampled, layer) && texelFetch(behindDepth, at, 0).r >= 0.8 * sampled;
    }
    places.at[i] = moved;
  }
  return places;
}

#ifdef MULTISAMPLED
// The same for each sample of the pixel by itself, which takes the colour of another: exact, since it is known of each how
// deep it lies.
Places displacedSamples(Displacement knobs, int ripple, sampler2DArray warp, sampler2DArray inflated, sampler2DArray depth,
                        sampler2DMSArray depthSamples, sampler2DArray behindDepth, ivec2 pixel, int layer) {
  ivec3 at = ivec3(pixel, layer);
  Places places = ownSamples(pixel);
  Tear tear = tearOf(knobs, warp, inflated, at);
  // Right at a silhouette the object itself may lie deeper than is thought.
  bool outside = ripple == kRipplePaper || nearestAround(depth, at) + tear.fall < tear.beyond;
  for (int i = 0; i < kPlaces; ++i) {
    float ownDepth = texelFetch(depthSamples, at, i).r;
    vec2 vector = tear.stays ? vec2(0.0) : vectorAt(tear, kSamplePlaces[i] - 0.5);
    vec2 moved = clamp(places.at[i] + vector, vec2(0.0), frame.imageSize - 0.01);
    float movedDepth = texelFetch(depthSamples, ivec3(moved, layer), sampleAt(moved)).r;
    if (ripple != kRipplePaper && tear.surface > 0.0) {
      float rise = riseOf(tear, vector);
      bool covered = ownDepth + tear.fall >= tear.beyond;
      bool keeps = (outside && !covered && movedDepth + tear.fall < tear.beyond) || movedDepth > tear.nearer + rise;
      if (keeps) moved = places.at[i], movedDepth = ownDepth;
      if (ripple == kRippleLayered && covered && movedDepth + rise < tear.beyond) {
        bool beside = isBeside(inflated, moved, movedDepth, layer);
        places.isBehind[i] = beside && texelFetch(behindDepth, at, 0).r >= 0.8 * movedDepth;
      }
    }
    places.at[i] = moved;
    places.depths[i] = movedDepth;
  }
  return places;
}
#endif
#endif
