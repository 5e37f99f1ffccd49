#version 460
// Shadow shapes: the blurred light is thresholded to hard, rounded edges, one or several; inside the dark an inner glow;
// where the breakup map is set, more steps (paper 000, section 5.1).
//
// Out: R: light; G: lens; B: the part of the light that is inner glow; A: coverage.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "final_shadow.shared.h"

layout(constant_id = 0) const int kIndicationSteps = 1;
layout(constant_id = 1) const int kShaded = 1;  // 0: everything lies in light or in shadow, as far as the blur reaches
layout(constant_id = 2) const int kLight = 7;   // kLightBlurred ...
layout(set = 1, binding = 0, scalar) uniform Block { FinalShadowUniforms u; };
layout(set = 1, binding = kFinalShadowBlurred) uniform sampler2DArray blurred;
layout(set = 1, binding = kFinalShadowShadow) uniform sampler2DArray shadow;
layout(set = 1, binding = kFinalShadowDepth) uniform sampler2DArray depthBuffer;
layout(set = 1, binding = kFinalShadowWarp) uniform sampler2DArray warp;

// Light before the blur; `own` where nothing is.
float rawLight(ivec2 pixel, int layer, float own) {
  vec4 s = texelFetch(shadow, ivec3(clamp(pixel, ivec2(0), ivec2(frame.imageSize) - 1), layer), 0);
  return s.a > 0.0 ? s.r / s.a : own;
}

vec4 shade(ivec2 pixel, int layer) {
  vec4 own = texelFetch(shadow, ivec3(pixel, layer), 0);
  own.rgb /= max(own.a, 1e-3);
  if (kShaded == 0) {
    float light = own.r > 0.0 ? 1.0 : 0.0, glow = (1.0 - light) * u.knobs.innerGlow * min(1.0 / u.glowReach, 1.0);
    return own.a > 0.0 ? vec4(light + glow, own.g, glow, own.a) : vec4(0.0);
  }
  vec4 warped = vec4(0.0);
  if ((kLight & kLightMarks) != 0) warped = texelFetch(warp, ivec3(pixel, layer), 0);
  float depth = min(eyeDepth(texelFetch(depthBuffer, ivec3(pixel, layer), 0).r, layer), 60000.0);

  // Blurred light: of the four texels around the pixel, those at its own depth count.
  vec2 position = (vec2(pixel) + 0.5) * 0.25 - 0.5;
  ivec2 corner = ivec2(floor(position)), last = textureSize(blurred, 0).xy - 1;
  vec2 f = position - vec2(corner);
  vec4 sides = vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y);
  float sum = 0.0, weights = 1e-6, sharpness = u.depthSharpness / (depth * depth);
  vec4 lights = vec4(0.0);
  for (int i = 0; i < ((kLight & kLightBlurred) != 0 ? 4 : 0); ++i) {
    ivec2 at = clamp(corner + ivec2(i & 1, i >> 1), ivec2(0), last);
    vec4 b = texelFetch(blurred, ivec3(at, layer), 0);
    lights[i] = b.r / max(b.a, 1e-3);
    float z = b.b - depth;
    float falloff = 1.0 / (1.0 + z * z * sharpness);
    float weight = sides[i] * falloff * falloff * b.a;
    sum += weight * lights[i];
    weights += weight;
  }
  // Beside a silhouette there may be none at its depth; then its own, unblurred light stands.
  float light = own.r;
  if ((kLight & kLightBlurred) != 0) light = mix(own.r, sum / weights, u.blurAmount * clamp(weights * 8.0, 0.0, 1.0));

  // FORMULAS 15: the edge is about `softness` pixels wide, whatever the slope of the blurred image.
  vec2 slope = 0.25 * vec2(mix(lights[1] - lights[0], lights[3] - lights[2], f.y),
                           mix(lights[2] - lights[0], lights[3] - lights[1], f.x));
  float steepness = length(slope);
  if ((kLight & kLightSharp) != 0) {
    // Its slope is the steeper side's, since it may go up and down within two pixels.
    vec2 before = vec2(rawLight(pixel - ivec2(1, 0), layer, own.r), rawLight(pixel - ivec2(0, 1), layer, own.r));
    vec2 after = vec2(rawLight(pixel + ivec2(1, 0), layer, own.r), rawLight(pixel + ivec2(0, 1), layer, own.r));
    steepness = mix(length(max(abs(before - own.r), abs(after - own.r))), steepness, u.blurAmount);
  }
  float width = max(0.5 * u.knobs.softness * steepness, 1e-3);

  // A dither of the ramp: the breakup map moves the threshold; where it does, its own slope softens the edge.
  float dither = u.knobs.dither * (0.5 - warped.b) * float(warped.a > 0.0);
  width = max(width, 0.05 * u.knobs.dither);
  float lit = dot(u.stepShares, smoothstep(u.stepThresholds - width, u.stepThresholds + width, vec4(light - dither)));

  // Texture indication: where the breakup map is set, marks push the blurred light over the threshold in a few more
  // steps, each a flat shape.
  float push = light + own.b * warped.b * u.knobs.indication;
  float pushed = 0.0;
  for (int i = 1; i <= kIndicationSteps; ++i) {
    float level = u.brightestEdge + 0.9 * u.knobs.indication * float(i) / float(kIndicationSteps);
    pushed += clamp(0.5 + (push - level) * 25.0, 0.0, 1.0);
  }
  if (own.b > 0.0) lit = max(lit, pushed * clamp(light * 6.0, 0.0, 1.0) / float(kIndicationSteps));

  // Inner glow: the inverted blur, clamped, adds light to the interior of the dark, none at its edge.
  float inside = clamp((u.darkestEdge - light) / u.darkestEdge / u.glowReach, 0.0, 1.0);
  float glow = (1.0 - lit) * u.knobs.innerGlow * inside;
  return own.a > 0.0 ? vec4(lit + glow, own.g, glow, own.a) : vec4(0.0);
}

#define OUTPUT_FORMAT rgba8
#define SHADES_TILES
#include "../../shading/image_pass.glsl"
