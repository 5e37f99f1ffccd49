#version 460
// One axis of a Gaussian blur, with optional halving along that axis (paper 000, section 5, "Blur Pass"). The shadow
// channels are premultiplied by coverage, and stay so: who reads the result divides by A, so that the background
// neither lightens nor darkens the shapes in front of it.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_multiview : require
#extension GL_EXT_scalar_block_layout : require
#include "blur.shared.h"

layout(set = 1, binding = 0, scalar) uniform Block { BlurStep blurStep; };
layout(set = 1, binding = 1) uniform sampler2DArray source;

vec4 shade(ivec2 pixel, int layer) {
  ivec2 axis = blurStep.vertical != 0 ? ivec2(0, 1) : ivec2(1, 0);
  ivec2 last = textureSize(source, 0).xy - 1;
  // Centre of the output pixel in source texels, along the axis: between two texels when halving.
  ivec2 first = blurStep.halving != 0 ? pixel * (ivec2(1) + axis) : pixel;
  float center = blurStep.halving != 0 ? 0.5 : 0.0;

  vec4 sum = vec4(0.0);
  float weights = 0.0;
  for (int i = -blurStep.reach; i <= blurStep.reach + blurStep.halving; ++i) {
    float x = float(i) - center;
    float weight = exp(-x * x * blurStep.falloff);
    sum += weight * texelFetch(source, ivec3(clamp(first + i * axis, ivec2(0), last), layer), 0);
    weights += weight;
  }
  return sum / weights;
}

#include "../../shading/image_pass.glsl"
