#version 460
// What MetaTexture needs to know of the inflated surface. The texture itself is evaluated by an image step, once a pixel:
// small triangles run their fragment shaders for many pixels that they do not cover.
//
// Target 0: bits of pattern u and v; dS/du and dS/dv in pixels per unit, each as two bfloat16 (a float's range, and a
//           precision of 0.4 percent, which is less than a hundredth of a blend).
// Target 1: R: amount / 64 pixels; G: (log2 of the texture's size in pixels) / 16; B: contrast; A: coverage. Half floats.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "../../shading/material.glsl"
#include "../../shading/metatexture.glsl"
#include "warp.glsl"

layout(constant_id = 0) const int kAlphaMode = 0;

layout(location = 0) in vec2 inUv;
layout(location = 1) in vec3 inTangentU;
layout(location = 2) in vec3 inTangentV;
layout(location = 3) in vec3 inBaseUvAlpha;
layout(location = 4) flat in vec2 inSizeContrast;
layout(location = 0) out uvec4 outPattern;
layout(location = 1) out vec4 outKnobs;

void main() {
  if (kAlphaMode != 0 && isHole(inBaseUvAlpha.xy, inBaseUvAlpha.z, kAlphaMode)) discard;
  // From clip space to pixels at this point: the tangents' x and y come in half image sizes.
  vec2 fromCenter = gl_FragCoord.xy - 0.5 * frame.imageSize;
  vec2 dSdu = (inTangentU.xy - fromCenter * inTangentU.z) * gl_FragCoord.w;
  vec2 dSdv = (inTangentV.xy - fromCenter * inTangentV.z) * gl_FragCoord.w;
  outPattern = uvec4(floatBitsToUint(inUv), packBfloat(dSdu), packBfloat(dSdv));
  float nearness = gl_FragCoord.w * gl_FragCoord.w;  // paper 000, eq. 26, with 1 / d^2
  outKnobs = vec4(warp.amount / 64.0 * nearness / (nearness + warp.distance * warp.distance), inSizeContrast, 1.0);
}
