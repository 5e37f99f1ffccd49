#version 460
// Warp vectors and breakup marks, attached to the surface by MetaTexture (paper 000, section 4).
// Out: R, G: vector in pixels (x right, y down); B: breakup marks in [0, 1]; A: eye depth of the inflated surface, 0 where
// there is none.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "../../shading/metatexture.glsl"

layout(set = 1, binding = 1) uniform usampler2DArray pattern;
layout(set = 1, binding = 2) uniform sampler2DArray knobs;
layout(set = 1, binding = 3) uniform sampler2DArray depth;
layout(set = 1, binding = 4) uniform sampler2D example;

vec4 shade(ivec2 pixel, int layer) {
  ivec3 at = ivec3(pixel, layer);
  vec4 knob = texelFetch(knobs, at, 0);
  uvec4 packed = texelFetch(pattern, at, 0);
  vec2 dSdu = unpackBfloat(packed.z), dSdv = unpackBfloat(packed.w);
  vec2 gradU, gradV;
  uvGradients(dSdu, dSdv, gradU, gradV);
  MetaTextureScale scale = metaTextureScale(gradU, gradV, dSdu, dSdv, exp2(knob.g * 16.0));
  vec3 sampled = metaTexture(example, uintBitsToFloat(packed.xy), scale, vec4(0.5), knob.b, frame.patternShift).rgb;

  // Camera roll (section 4.3): the frame of reference follows the gradient of u, so the pattern sticks to the surface.
  float lengthU = length(gradU);
  vec2 axis = lengthU > 0.0 ? gradU / lengthU : vec2(1.0, 0.0);
  vec2 vector = sampled.xy * 2.0 - 1.0;
  vector = vec2(axis.x * vector.x - axis.y * vector.y, axis.y * vector.x + axis.x * vector.y);
  vector *= knob.r * 64.0 * frame.pixelScale;
  float far = min(eyeDepth(texelFetch(depth, at, 0).r, layer), 60000.0);
  return knob.a > 0.0 ? vec4(vector, clamp(sampled.b, 0.0, 1.0), far) : vec4(0.0);
}

#include "../../shading/image_pass.glsl"
