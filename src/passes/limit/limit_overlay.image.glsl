#version 460
// An overlay of the picture in the colours of a palette.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "../../shading/oklab.glsl"
#include "limit.shared.h"

layout(constant_id = 0) const int kColors = 16;         // the palette's, rounded up to a multiple of 4
layout(constant_id = 1) const bool kIsOpaque = false;  // paint: it covers or it does not, or mixtures would show
layout(set = 1, binding = 0, scalar) uniform Block { LimitOverlayUniforms u; };
layout(set = 1, binding = kLimitOverlay) uniform sampler2DArray overlay;
#define PALETTE u.colors
#include "../../shading/nearest_color.glsl"

// Steepness of the coverage of opaque paint, around a half: edges stay about as wide as a pixel.
const float kSteepness = 4.0;

vec4 shade(ivec2 pixel, int layer) {
  vec4 own = texelFetch(overlay, ivec3(pixel, layer), 0);
  vec3 root = own.rgb / max(own.a, 1e-6);
  vec3 weights = vec3(u.lightness, 1.0, 1.0);
  vec3 lab = weights * oklabFromConeRoots(cubeRoot(conesFromLinear(root * root)));
  vec3 limited = mix(lab, nearestColor(lab), u.amount) / weights;
  float coverage = own.a;
  if (kIsOpaque) coverage = mix(coverage, clamp(0.5 + kSteepness * (coverage - 0.5), 0.0, 1.0), u.amount);
  return vec4(sqrt(max(linearFromOklab(limited), vec3(0.0))) * coverage, coverage);
}

#include "../../shading/image_pass.glsl"
