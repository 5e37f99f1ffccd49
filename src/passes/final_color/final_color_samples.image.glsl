#version 460
// The picture where pixels have several samples, and nothing but grades was done to the colours of surfaces: what the
// colour pass gives, and where edges are torn, for each sample of a pixel the colour of another one, with bloom from the
// lens channel.
#extension GL_GOOGLE_include_directive : require
#define MULTISAMPLED
#include "../../shading/frame.glsl"
#include "../../shading/displacement.glsl"
#include "final_color.shared.h"

layout(constant_id = 0) const int kOptions = 3;  // kFinalColorGlows ...
layout(constant_id = 1) const int kRipple = 0;   // of displacement.shared.h; layered: there is what lies behind
layout(constant_id = 2) const int kPart = 0;     // of surface_color.shared.h, where nothing is torn
const bool kHasBlended = (kOptions & kFinalColorHasBlended) != 0;
layout(set = 1, binding = 0, scalar) uniform Block {
  vec3 bloom;
  Displacement displacement;
  SurfaceColors colors;
};
layout(set = 1, binding = kFinalColorColor) uniform sampler2DArray depth;
layout(set = 1, binding = kFinalColorWarp) uniform sampler2DArray warp;
layout(set = 1, binding = kFinalColorDepth) uniform sampler2DMSArray depthSamples;
layout(set = 1, binding = kFinalColorBloom) uniform sampler2DArray glow;
layout(set = 1, binding = kFinalColorBehind) uniform sampler2DArray behind;
layout(set = 1, binding = kFinalColorBehindDepth) uniform sampler2DArray behindDepth;
layout(set = 1, binding = kFinalColorLight) uniform sampler2DArray finalShadow;
layout(set = 1, binding = kFinalColorLit) uniform sampler2DArray lit;
layout(set = 1, binding = kFinalColorInflated) uniform sampler2DArray inflated;
layout(set = 1, binding = kFinalColorShadowed) uniform sampler2DArray shadowed;
layout(set = 1, binding = kFinalColorSampleLight) uniform sampler2DArray sampleLight;
layout(set = 1, binding = kFinalColorLitSamples) uniform sampler2DMSArray litSamples;
layout(set = 1, binding = kFinalColorShadowedSamples) uniform sampler2DMSArray shadowedSamples;
layout(set = 1, binding = kFinalColorGraded) uniform sampler2DArray graded;
layout(set = 1, binding = kFinalColorUngraded) uniform sampler2DArray ungraded;
layout(set = 1, binding = kFinalColorBlended) uniform sampler2DArray blended;
layout(set = 1, binding = kFinalColorBlendedDistance) uniform sampler2DArray blendedDistance;
#include "../../shading/surface_color.glsl"

bool hasGlowColor() { return (kOptions & kFinalColorGlowColor) != 0; }

// A sample's colour after grades, which are known of whole pixels: it changes as its pixel does, and is no other colour than
// those that are graded around it, but for half of how far these are apart.
vec3 gradedSample(vec4 color, ivec3 at) {
  vec4 own = texelFetch(graded, at, 0), before = texelFetch(ungraded, at, 0);
  if (own.rgb == before.rgb) return color.rgb;
  vec3 straight = own.rgb / max(own.a, 1e-3), least = straight, most = straight;
  ivec2 last = ivec2(frame.imageSize) - 1;
  for (int i = 0; i < 4; ++i) {
    ivec2 beside = clamp(at.xy + ivec2((i & 1) * 2 - 1, (i >> 1) * 2 - 1), ivec2(0), last);
    vec4 there = texelFetch(graded, ivec3(beside, at.z), 0);
    vec3 other = there.a > 0.0 ? there.rgb / there.a : straight;
    least = min(least, other);
    most = max(most, other);
  }
  vec3 margin = 0.5 * (most - least), changed = color.rgb + own.rgb - before.rgb;
  return clamp(changed, (least - margin) * color.a, (most + margin) * color.a);
}

vec4 torn(ivec2 pixel, int layer) {
  Places places = displacedSamples(displacement, kRipple, warp, inflated, depth, depthSamples, behindDepth, pixel, layer);
  vec4 sum = vec4(0.0);
  for (int i = 0; i < kPlaces; ++i) {
    ivec3 at = ivec3(places.at[i], layer);
    int number = sampleAt(places.at[i]);
    vec4 color = sampleColor(texelFetch(litSamples, at, number), at, number, places.depths[i]);
    color = overSky(color, vec2(at.xy) + 0.5, layer);
    if ((kOptions & kFinalColorIsGraded) != 0) color.rgb = gradedSample(color, at);
    if (kRipple == kRippleLayered && places.isBehind[i]) color = texelFetch(behind, ivec3(pixel, layer), 0);
    sum += color / float(kPlaces);
  }
  return sum;
}

vec4 shade(ivec2 pixel, int layer) {
  vec4 result;
  if ((kOptions & kFinalColorTorn) != 0)
    result = torn(pixel, layer);
  else if ((kOptions & kFinalColorIsGraded) != 0)
    result = texelFetch(graded, ivec3(pixel, layer), 0);
  else
    result = colorOf(pixel, layer, kPart);
  if ((kOptions & kFinalColorGlows) != 0)
    result.rgb += bloom * sqrt(textureLod(glow, vec3((vec2(pixel) + 0.5) / frame.imageSize, layer), 0.0).r) * result.a;
  return result;
}

#define SHADES_TILES
#include "../../shading/image_pass.glsl"
