#version 460
// The image half of the Color Pass: lit and shadowed colours mixed by the final shadow, in the air, over the sky.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "color.shared.h"

layout(constant_id = 0) const int kPart = 0;  // kPartAll ...
layout(set = 1, binding = 0, scalar) uniform Block { ColorUniforms u; };
layout(set = 1, binding = kColorLight) uniform sampler2DArray finalShadow;
layout(set = 1, binding = kColorLit) uniform sampler2DArray lit;
layout(set = 1, binding = kColorShadowed) uniform sampler2DArray shadowed;
layout(set = 1, binding = kColorDepth) uniform sampler2DArray depth;

vec3 sky(vec2 ndc, int layer) {
  vec4 toRay = VIEW_FIELD(ndcToEyeRay, layer);
  vec3 ray = vec3((ndc * toRay.xy + toRay.zw) * (1.0 - VIEW_FIELD(orthographic, layer)), -1.0);
  float sine = dot(VIEW_FIELD(upInEye, layer), ray) * inversesqrt(dot(ray, ray));  // of the elevation
  float t = clamp(sine / u.height, 0.0, 1.0);
  return mix(u.horizon, u.zenith, t * t * (3.0 - 2.0 * t));
}

vec4 shade(ivec2 pixel, int layer) {
  ivec3 at = ivec3(pixel, layer);
  vec3 beyond = sky((vec2(pixel) + 0.5) / frame.imageSize * 2.0 - 1.0, layer) * (1.0 - u.transparent);
  if (kPart == kPartSky) return vec4(beyond, 1.0 - u.transparent);
  vec4 litRoot = texelFetch(lit, at, 0);
  if (kPart == kPartLit) return vec4(litRoot.rgb * litRoot.rgb, 1.0);
  vec4 shadowedRoot = texelFetch(shadowed, at, 0);
  vec4 shadow = vec4(u.deepGlow, 0.0, u.deepGlow, 1.0);
  if (kPart != kPartDark) shadow = texelFetch(finalShadow, at, 0);
  // Resolved colours are premultiplied by their coverage.
  float coverage = litRoot.a, whole = 1.0 / max(coverage, 1e-3);
  litRoot *= whole;
  shadowedRoot *= whole;
  vec3 litColor = litRoot.rgb * litRoot.rgb;
  vec3 color = mix(shadowedRoot.rgb * shadowedRoot.rgb, litColor, shadow.r);
  // Roots are about as far apart as the eye sees colours.
  vec3 root = mix(shadowedRoot.rgb, litRoot.rgb, shadow.r);
  color = mix(color, root * root, u.mixesValues);
  // Blue is the part of the light that is inner glow: another colour takes the place of the lit one there.
  color += shadow.b * u.glowColorAmount * (u.glowColor - litColor);

  if (kPart == kPartDark) return vec4(color, 1.0);

  float distance = eyeDepth(texelFetch(depth, at, 0).r, layer);
  color = mix(color, u.horizon, u.knobs.air * smoothstep(u.airStart, u.airEnd, distance)) * coverage;

  float open = 1.0 - coverage;
  return vec4(color + beyond * open, coverage + open * (1.0 - u.transparent));
}

#define SHADES_TILES
#include "../../shading/image_pass.glsl"
