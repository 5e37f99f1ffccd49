#version 460
// Which objects make up a pixel of the picture, and how much of it each: the samples at the places that its colour comes
// from, weighted as the filter there weights colours; or (SAMPLED) those samples that it is the mean of.
#extension GL_GOOGLE_include_directive : require
#define OUTPUT_FORMAT rgba32f
#define SHADES_TWO
#ifdef SAMPLED
#define MULTISAMPLED
#endif
#include "../../shading/byte_bits.glsl"
#include "../../shading/displacement.glsl"
#include "../../shading/frame.glsl"
#include "../../shading/tiles.shared.h"
#include "matte.shared.h"

layout(constant_id = 0) const int kRipple = 0;  // of displacement.shared.h; layered: there are objects behind
layout(set = 1, binding = 0, scalar) uniform Block { MatteUniforms u; };
#ifdef SAMPLED
layout(set = 1, binding = kMatteObjects) uniform sampler2DMSArray objects4;  // the frame's four samples
layout(set = 1, binding = kMatteDepthSamples) uniform sampler2DMSArray depthSamples;
const int kGroups = 1;  // of four places
#elif defined(MULTISAMPLED)
layout(set = 1, binding = kMatteObjects) uniform sampler2DMSArray objects4;  // the frame's four samples
const int kGroups = 4 * kPlaces;  // of four samples
const bool kMixes = true;
#else
layout(set = 1, binding = kMatteObjects) uniform sampler2DArray objects1;
const int kGroups = kPlaces;  // of four texels
const bool kMixes = false;
#endif
layout(set = 1, binding = kMatteWarp) uniform sampler2DArray warp;
layout(set = 1, binding = kMatteInflated) uniform sampler2DArray inflated;
layout(set = 1, binding = kMatteTiles) uniform sampler2DArray tiles;
layout(set = 1, binding = kMatteDepth) uniform sampler2DArray depth;
layout(set = 1, binding = kMatteBehind) uniform sampler2DArray behind;
layout(set = 1, binding = kMatteBehindDepth) uniform sampler2DArray behindDepth;

const float kNone = 1e30;  // after all objects' numbers

void shadeTwo(ivec2 pixel, int layer, out vec4 first, out vec4 second) {
  uint flags = bitsOf(texelFetch(tiles, ivec3(pixel / kTileSize, layer), 0).r);
  vec4 numbers[kGroups], weights[kGroups];
#ifdef SAMPLED
  Places places = ownSamples(pixel);
  if ((flags & kTileTorn) != 0u)
    places = displacedSamples(u.displacement, kRipple, warp, inflated, depth, depthSamples, behindDepth, pixel, layer);
  weights[0] = vec4(1.0 / float(kPlaces));
  for (int i = 0; i < kPlaces; ++i) {
    numbers[0][i] = texelFetch(objects4, ivec3(places.at[i], layer), sampleAt(places.at[i])).r;
    if (kRipple == kRippleLayered && places.isBehind[i]) numbers[0][i] = texelFetch(behind, ivec3(pixel, layer), 0).r;
  }
#else
  Places places = undisplaced(pixel);
  if ((flags & kTileTorn) != 0u)
    places = displaced(u.displacement, kRipple, kMixes, warp, inflated, depth, behindDepth, pixel, layer);
  ivec2 last = ivec2(frame.imageSize) - 1;
  for (int i = 0; i < kPlaces; ++i) {
    // Weights in steps of 1/256, as Vulkan asks of filters: all sums are exact then, in whatever order, and what is
    // covered wholly is so by exactly 1.
    vec2 low = floor(places.at[i] - 0.5);
    vec2 f = round((places.at[i] - 0.5 - low) * 256.0) / 256.0;
    ivec2 a = clamp(ivec2(low), ivec2(0), last), d = min(ivec2(low) + 1, last);
    vec4 texelWeights =
        vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y) / float(kPlaces);
    bool isBehind = kRipple == kRippleLayered && places.isBehind[i];
    vec4 hidden = vec4(texelFetch(behind, ivec3(pixel, layer), 0).r);
#ifdef MULTISAMPLED
#define SAMPLES(x, y)                                                                                         \
  vec4(texelFetch(objects4, ivec3(x, y, layer), 0).r, texelFetch(objects4, ivec3(x, y, layer), 1).r,          \
       texelFetch(objects4, ivec3(x, y, layer), 2).r, texelFetch(objects4, ivec3(x, y, layer), 3).r)
    numbers[4 * i + 0] = SAMPLES(a.x, a.y);
    numbers[4 * i + 1] = SAMPLES(d.x, a.y);
    numbers[4 * i + 2] = SAMPLES(a.x, d.y);
    numbers[4 * i + 3] = SAMPLES(d.x, d.y);
    for (int g = 0; g < 4; ++g) {
      weights[4 * i + g] = vec4(0.25 * texelWeights[g]);
      if (isBehind) numbers[4 * i + g] = hidden;
    }
#else
    numbers[i] = vec4(texelFetch(objects1, ivec3(a, layer), 0).r, texelFetch(objects1, ivec3(d.x, a.y, layer), 0).r,
                      texelFetch(objects1, ivec3(a.x, d.y, layer), 0).r, texelFetch(objects1, ivec3(d, layer), 0).r);
    weights[i] = texelWeights;
    if (isBehind) numbers[i] = hidden;
#endif
  }
#endif
  for (int g = 0; g < kGroups; ++g) {
    bvec4 counts = greaterThan(numbers[g] * weights[g], vec4(0.0));
    numbers[g] = mix(vec4(kNone), numbers[g], counts);
  }

  // Object by object, from the lowest number on, which is thereby the first among equals; nearly everywhere there is but
  // one.
  vec4 ids = vec4(0.0), coverages = vec4(0.0);
  while (true) {
    vec4 least = numbers[0];
    for (int g = 1; g < kGroups; ++g) least = min(least, numbers[g]);
    float number = min(min(least.x, least.y), min(least.z, least.w));
    if (number >= kNone) break;
    float coverage = 0.0;
    for (int g = 0; g < kGroups; ++g) {
      bvec4 its = equal(numbers[g], vec4(number));
      coverage += dot(vec4(its), weights[g]);
      numbers[g] = mix(numbers[g], vec4(kNone), its);
    }
    bvec4 before = greaterThanEqual(coverages, vec4(coverage)), from = bvec4(true, before.xyz);
    ids = mix(mix(vec4(0.0, ids.xyz), vec4(number), from), ids, before);
    coverages = mix(mix(vec4(0.0, coverages.xyz), vec4(coverage), from), coverages, before);
  }
  first = vec4(ids.x, coverages.x, ids.y, coverages.y);
  second = vec4(ids.z, coverages.z, ids.w, coverages.w);
}

#include "../../shading/image_pass.glsl"
