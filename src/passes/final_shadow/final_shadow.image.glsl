#version 460
// Shadow shapes: the blurred light is thresholded to hard, rounded edges, one or several; inside the dark an inner glow;
// where the breakup map is set, more steps (paper 000, section 5.1).
//
// Out: R: light; G: lens; B: the part of the light that is inner glow; A: coverage. Where pixels have several samples, a
// second image: the light of each.
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
#ifdef MULTISAMPLED
layout(set = 1, binding = kFinalShadowSamples) uniform sampler2DMSArray shadowSamples;
layout(set = 1, binding = kFinalShadowDepthSamples) uniform sampler2DMSArray depthSamples;
#endif

// Light before the blur; `own` where nothing is.
float rawLight(ivec2 pixel, int layer, float own) {
  vec4 s = texelFetch(shadow, ivec3(clamp(pixel, ivec2(0), ivec2(frame.imageSize) - 1), layer), 0);
  return s.a > 0.0 ? s.r / s.a : own;
}

// Blurred light around a pixel: of the four texels around it, those at a surface's own depth count.
struct Around {
  vec4 lights, depths, weights;
  vec2 slope;
};

Around aroundOf(ivec2 pixel, int layer) {
  vec2 position = (vec2(pixel) + 0.5) * 0.25 - 0.5;
  ivec2 corner = ivec2(floor(position)), last = textureSize(blurred, 0).xy - 1;
  vec2 f = position - vec2(corner);
  vec4 sides = vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y);
  Around a = Around(vec4(0.0), vec4(0.0), vec4(0.0), vec2(0.0));
  for (int i = 0; i < ((kLight & kLightBlurred) != 0 ? 4 : 0); ++i) {
    ivec2 at = clamp(corner + ivec2(i & 1, i >> 1), ivec2(0), last);
    vec4 b = texelFetch(blurred, ivec3(at, layer), 0);
    a.lights[i] = b.r / max(b.a, 1e-3);
    a.depths[i] = b.b;
    a.weights[i] = sides[i] * b.a;
  }
  a.slope = 0.25 * vec2(mix(a.lights[1] - a.lights[0], a.lights[3] - a.lights[2], f.y),
                        mix(a.lights[2] - a.lights[0], a.lights[3] - a.lights[1], f.x));
  return a;
}

// Light and, as a part of it, inner glow of a surface. `own`: its light before the blur, and where the breakup map may act.
// `warped`: the warp there. `width`: of the edge.
vec2 lightOf(Around around, vec2 own, float depth, vec4 warped, float width) {
  // Beside a silhouette there may be none at its depth; then its own, unblurred light stands.
  float light = own.x;
  if ((kLight & kLightBlurred) != 0) {
    vec4 z = around.depths - depth;
    vec4 falloff = 1.0 / (1.0 + z * z * (u.depthSharpness / (depth * depth)));
    vec4 shares = around.weights * falloff * falloff;
    float weights = 1e-6 + dot(shares, vec4(1.0));
    light = mix(own.x, dot(shares, around.lights) / weights, u.blurAmount * clamp(weights * 8.0, 0.0, 1.0));
  }

  // A dither of the ramp: the breakup map moves the threshold; where it does, its own slope softens the edge.
  float dither = u.knobs.dither * (0.5 - warped.b) * float(warped.a > 0.0);
  float lit = dot(u.stepShares, smoothstep(u.stepThresholds - width, u.stepThresholds + width, vec4(light - dither)));

  // Texture indication: where the breakup map may act, marks break the transition up into more steps, each a flat shape, on
  // both sides of the edge: where the map is high, dark ones in the light, and where it is low, light ones in the dark. The
  // farther from the terminator, the stronger a mark must be.
  float mark = float(warped.a > 0.0) * (2.0 * warped.b - 1.0), reach = own.y * u.knobs.indication;
  vec2 marks = vec2(0.0);  // dark ones, light ones
  for (int i = 1; i <= kIndicationSteps; ++i) {
    float least = 1.0 - reach * float(i) / float(kIndicationSteps);
    marks += clamp((vec2(mark, -mark) - least) * 12.0, 0.0, 1.0) / float(kIndicationSteps);
  }
  marks.y *= clamp(light * 6.0, 0.0, 1.0);
  lit = clamp(lit, u.stepShares.x * marks.y, 1.0 - u.stepShares.x * marks.x);

  // Inner glow: the inverted blur, clamped, adds light to the interior of the dark, none at its edge.
  float inside = clamp((u.darkestEdge - light) / u.darkestEdge / u.glowReach, 0.0, 1.0);
  float glow = (1.0 - lit) * u.knobs.innerGlow * inside;
  return vec2(lit + glow, glow);
}

// `samples`: the light of each sample of the pixel, where it has several.
vec4 shadeSamples(ivec2 pixel, int layer, out vec4 samples) {
  ivec3 at = ivec3(pixel, layer);
  vec4 own = texelFetch(shadow, at, 0);
  own.rgb /= max(own.a, 1e-3);
  if (kShaded == 0) {
    float light = own.r > 0.0 ? 1.0 : 0.0, glow = (1.0 - light) * u.knobs.innerGlow * min(1.0 / u.glowReach, 1.0);
    samples = vec4(light + glow);
    return own.a > 0.0 ? vec4(light + glow, own.g, glow, own.a) : vec4(0.0);
  }
  vec4 warped = vec4(0.0);
  if ((kLight & kLightMarks) != 0) warped = texelFetch(warp, at, 0);
  Around around = aroundOf(pixel, layer);

  // FORMULAS 15: the edge is about `softness` pixels wide, whatever the slope of the blurred image.
  float steepness = length(around.slope);
  if ((kLight & kLightSharp) != 0) {
    // Its slope is the steeper side's, since it may go up and down within two pixels.
    vec2 before = vec2(rawLight(pixel - ivec2(1, 0), layer, own.r), rawLight(pixel - ivec2(0, 1), layer, own.r));
    vec2 after = vec2(rawLight(pixel + ivec2(1, 0), layer, own.r), rawLight(pixel + ivec2(0, 1), layer, own.r));
    steepness = mix(length(max(abs(before - own.r), abs(after - own.r))), steepness, u.blurAmount);
  }
  float width = max(max(0.5 * u.knobs.softness * steepness, 1e-3), 0.05 * u.knobs.dither);

  float depth = min(eyeDepth(texelFetch(depthBuffer, at, 0).r, layer), 60000.0);
  vec2 light = lightOf(around, own.rb, depth, warped, width);
  samples = vec4(light.x);
#ifdef MULTISAMPLED
  // Samples of several surfaces have their own: a mean of both light and shadow is neither. Loops that do not run cost
  // nothing.
  vec4 raw = vec4(0.0), reached = vec4(0.0), covered = vec4(1.0);
  for (int s = 0; s < ((kLight & kLightSeveral) != 0 ? 4 : 0); ++s) {
    vec4 there = texelFetch(shadowSamples, at, s);
    covered[s] = there.a, raw[s] = there.r / max(there.a, 1e-3), reached[s] = there.b / max(there.a, 1e-3);
  }
  bool areSeveral = raw != raw.xxxx || covered != vec4(1.0);
  for (bool again = areSeveral; again; again = false) {
    vec2 sum = vec2(0.0);
    for (int s = 0; s < 4; ++s) {
      float there = min(eyeDepth(texelFetch(depthSamples, at, s).r, layer), 60000.0);
      vec2 one = lightOf(around, vec2(raw[s], reached[s]), there, warped, width);
      samples[s] = one.x;
      sum += covered[s] * one;
    }
    light = sum / max(dot(covered, vec4(1.0)), 1e-3);
  }
#endif
  return own.a > 0.0 ? vec4(light.x, own.g, light.y, own.a) : vec4(0.0);
}

#ifdef MULTISAMPLED
#define SHADES_TWO
void shadeTwo(ivec2 pixel, int layer, out vec4 first, out vec4 second) { first = shadeSamples(pixel, layer, second); }
#else
vec4 shade(ivec2 pixel, int layer) {
  vec4 samples;
  return shadeSamples(pixel, layer, samples);
}
#endif

#define OUTPUT_FORMAT rgba8
#define SHADES_TILES
#include "../../shading/image_pass.glsl"
