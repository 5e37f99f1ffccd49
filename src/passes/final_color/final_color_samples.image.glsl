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
#include "../../shading/surface_color.glsl"

bool hasGlowColor() { return (kOptions & kFinalColorGlowColor) != 0; }

vec4 torn(ivec2 pixel, int layer) {
  Places places = displacedSamples(displacement, kRipple, warp, inflated, depth, depthSamples, behindDepth, pixel, layer);
  vec4 sum = vec4(0.0);
  for (int i = 0; i < kPlaces; ++i) {
    ivec3 at = ivec3(places.at[i], layer);
    int number = sampleAt(places.at[i]);
    vec4 color = sampleColor(texelFetch(litSamples, at, number), at, number, places.depths[i]);
    color += skyAt(vec2(at.xy) + 0.5, layer) * (1.0 - color.a);
    if ((kOptions & kFinalColorIsGraded) != 0) color += texelFetch(graded, at, 0) - texelFetch(ungraded, at, 0);
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
