// The colour of a pixel, or of one of its samples: lit and shadowed colours mixed by the final shadow, in the air, over the
// sky. Whoever includes it has a SurfaceColors `colors` and the images `finalShadow`, `lit`, `shadowed` and `depth`; with
// MULTISAMPLED also `sampleLight`, `litSamples`, `shadowedSamples` and `depthSamples`, and hasGlowColor(). kHasBlended says
// whether there are blended surfaces in air, which then are in the images `blended` and `blendedDistance`.
#ifndef SCUMBLE_SURFACE_COLOR_GLSL
#define SCUMBLE_SURFACE_COLOR_GLSL
#include "blended_parts.glsl"
#include "frame.glsl"
#include "surface_color.shared.h"
#include "sky.glsl"

// A surface, premultiplied by its coverage. `glow`: the part of the light that is inner glow.
vec4 surfaceColor(vec4 litRoot, vec4 shadowedRoot, float light, float glow) {
  // Resolved colours are premultiplied by their coverage.
  float coverage = litRoot.a, whole = 1.0 / max(coverage, 1e-3);
  litRoot *= whole;
  shadowedRoot *= whole;
  vec3 litColor = litRoot.rgb * litRoot.rgb;
  vec3 color = mix(shadowedRoot.rgb * shadowedRoot.rgb, litColor, light);
  // Roots are about as far apart as the eye sees colours.
  vec3 root = mix(shadowedRoot.rgb, litRoot.rgb, light);
  color = mix(color, root * root, colors.mixesValues);
  // Another colour takes the place of the lit one where there is glow.
  color += glow * colors.glowColorAmount * (colors.glowColor - litColor);
  return vec4(color, 1.0) * coverage;
}

float airBefore(float distance) {
  return colors.air * smoothstep(colors.airStart, colors.airEnd, distance);
}

// A surface, premultiplied, dissolved in the air before it; of blended ones and what shows through them each by itself.
// Where nothing has a depth there are blended ones alone.
vec4 inAir(vec4 color, float depthValue, ivec3 at) {
  float part = depthValue > 0.0 ? airBefore(eyeDepth(depthValue, at.z)) : 0.0;
  vec4 dissolved = vec4(mix(color.rgb, colors.horizon * color.a, part), color.a);
  if (kHasBlended) {
    vec4 front = texelFetch(blended, at, 0);
    float near = airBefore(blendedDistanceOf(texelFetch(blendedDistance, at, 0)));
    for (bool isThrough = front.a > 0.0 && near + part > 0.0; isThrough; isThrough = false) {
      vec3 root = sqrt(color.rgb / max(color.a, 1e-6));
      BlendedParts parts = blendedParts(root, color.a, front.rgb / max(front.a, 1e-6), front.a);
      parts.before = sqrt(mix(parts.before * parts.before, colors.horizon, near));
      parts.behind = sqrt(mix(parts.behind * parts.behind, colors.horizon, part));
      dissolved.rgb = mixedColor(parts) * color.a;
    }
  }
  return dissolved;
}

#ifdef MULTISAMPLED
// Whether the inner glow has a colour of its own: else nobody asks how much of the light it is.
bool hasGlowColor();

vec4 sampleColor(vec4 litRoot, ivec3 at, int number, float depthValue) {
  float light = texelFetch(sampleLight, at, 0)[number];
  // Of the samples' light the pixel's glow is a part as well.
  float glow = hasGlowColor() ? min(texelFetch(finalShadow, at, 0).b, light) : 0.0;
  return inAir(surfaceColor(litRoot, texelFetch(shadowedSamples, at, number), light, glow), depthValue, at);
}
#endif

vec4 colorOf(ivec2 pixel, int layer, int part) {
  ivec3 at = ivec3(pixel, layer);
  vec2 place = vec2(pixel) + 0.5;
  if (part == kPartSky) return skyAt(place, layer);
#ifdef MULTISAMPLED
  // Where samples are of several surfaces, the mean of their colours is not the colour of their means. Loops that do not
  // run cost nothing.
  if (part == kPartMixed) {
    vec4 roots[4], lights = texelFetch(sampleLight, at, 0);
    bool areSeveral = lights != lights.xxxx;
    for (int s = 0; s < 4; ++s) {
      roots[s] = texelFetch(litSamples, at, s);
      areSeveral = areSeveral || roots[s] != roots[0];
    }
    vec4 color = sampleColor(roots[0], at, 0, texelFetch(depthSamples, at, 0).r);
    for (bool again = areSeveral; again; again = false) {
      for (int s = 1; s < 4; ++s) color += sampleColor(roots[s], at, s, texelFetch(depthSamples, at, s).r);
      color *= 0.25;
    }
    return overSky(color, place, layer);
  }
#endif
  vec4 litRoot = texelFetch(lit, at, 0);
  if (part == kPartLit) return vec4(litRoot.rgb * litRoot.rgb, 1.0);
  vec4 shadowedRoot = texelFetch(shadowed, at, 0);
  vec4 shadow = vec4(colors.deepGlow, 0.0, colors.deepGlow, 1.0);
  if (part != kPartDark) shadow = texelFetch(finalShadow, at, 0);
  vec4 color = surfaceColor(litRoot, shadowedRoot, shadow.r, shadow.b);
  if (part == kPartDark) return vec4(color.rgb, 1.0);
  color = inAir(color, texelFetch(depth, at, 0).r, at);
  return overSky(color, place, layer);
}
#endif
