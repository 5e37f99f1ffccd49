#version 460
// One axis of a Gaussian blur, with optional halving along that axis (paper 000, section 5, "Blur Pass"). Beyond the
// paper, a tap counts only as far as it lies at the same depth as the centre: light does not leak from what is behind
// into the shapes in front, which would draw a halo around them.
//
// In:  R, G: light and lens, premultiplied by coverage; A: coverage.
// Out: the same, and in B the eye depth, on which the next step relies.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_multiview : require
#include "../../shading/frame.glsl"
#include "blur.shared.h"

layout(set = 1, binding = 0, scalar) uniform Block { BlurStep blurStep; };
layout(set = 1, binding = 1) uniform sampler2DArray source;
layout(set = 1, binding = 2) uniform sampler2DArray depth;  // read by the first step only

vec4 fetch(ivec2 texel, int layer) {
  vec4 t = texelFetch(source, ivec3(texel, layer), 0);
  if (blurStep.first != 0) t.b = min(eyeDepth(texelFetch(depth, ivec3(texel, layer), 0).r, layer), 60000.0);
  return t;
}

vec4 shade(ivec2 pixel, int layer) {
  ivec2 axis = blurStep.vertical != 0 ? ivec2(0, 1) : ivec2(1, 0);
  ivec2 last = textureSize(source, 0).xy - 1;
  // Centre of the output pixel in source texels, along the axis: between two texels when halving.
  ivec2 first = blurStep.halving != 0 ? pixel * (ivec2(1) + axis) : pixel;
  float center = blurStep.halving != 0 ? 0.5 : 0.0;
  float ownDepth = fetch(min(first, last), layer).b;
  float depthFalloff = blurStep.depthFalloff / (ownDepth * ownDepth);

  vec4 sum = vec4(0.0);
  float weights = 0.0;
  for (int i = -blurStep.reach; i <= blurStep.reach + blurStep.halving; ++i) {
    vec4 tap = fetch(clamp(first + i * axis, ivec2(0), last), layer);
    float x = float(i) - center, z = tap.b - ownDepth;
    float weight = exp(-x * x * blurStep.falloff - z * z * depthFalloff);
    sum += weight * tap;
    weights += weight;
  }
  sum /= weights;
  return vec4(sum.rg, ownDepth, sum.a);
}

#include "../../shading/image_pass.glsl"
