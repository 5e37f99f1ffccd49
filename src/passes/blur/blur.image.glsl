#version 460
// One axis of a Gaussian blur, with optional downsampling along that axis (paper 000, section 5, "Blur Pass"). Beyond
// the paper, a tap counts only as far as it lies at the same depth as the centre: light does not leak from what is behind
// into the shapes in front, which would draw a halo around them.
//
// In:  R, G: light and lens, premultiplied by coverage; A: coverage.
// Out: the same, and in B the eye depth, on which the next step relies.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "blur.shared.h"

layout(constant_id = 0) const int kFirst = 0;  // 1: depth comes from the depth buffer, else from B
layout(constant_id = 1) const int kTaps = 1;
layout(set = 1, binding = 0, scalar) uniform Block { BlurStep blurStep; };
layout(set = 1, binding = kBlurSource) uniform sampler2DArray source;
layout(set = 1, binding = kBlurDepth) uniform sampler2DArray depth;

float fetchDepth(ivec2 texel, int layer) {
  return min(eyeDepth(texelFetch(depth, ivec3(texel, layer), 0).r, layer), 60000.0);
}

vec4 shade(ivec2 pixel, int layer) {
  ivec2 last = textureSize(source, 0).xy - 1;
  // The texel left of (above) the output pixel's centre, and the first tap.
  ivec2 center = min(pixel * blurStep.scale + blurStep.axis * ((blurStep.factor - 1) / 2), last);
  ivec2 first = pixel * blurStep.scale + blurStep.axis * blurStep.firstTap;
  float ownDepth = kFirst != 0 ? fetchDepth(max(center, ivec2(0)), layer)
                               : texelFetch(source, ivec3(max(center, ivec2(0)), layer), 0).b;
  float sharpness = blurStep.depthSharpness / (ownDepth * ownDepth);

  vec4 sum = vec4(0.0);
  float weights = 1e-6;
  for (int i = 0; i < kTaps; ++i) {
    ivec2 at = clamp(first + i * blurStep.axis, ivec2(0), last);
    vec4 tap = texelFetch(source, ivec3(at, layer), 0);
    if (kFirst != 0) tap.b = fetchDepth(at, layer);
    float z = tap.b - ownDepth;
    float falloff = 1.0 / (1.0 + z * z * sharpness);
    float weight = blurStep.weights[i] * falloff * falloff;
    sum += weight * tap;
    weights += weight;
  }
  sum /= weights;
  return vec4(sum.rg, ownDepth, sum.a);
}

#define SHADES_TILES
#include "../../shading/image_pass.glsl"
