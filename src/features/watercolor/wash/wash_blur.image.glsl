#version 460
// A Gaussian along x, then along y, of so many texels at a quarter of the size.
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/frame.glsl"
#include "../watercolor.shared.h"

layout(constant_id = 0) const bool kAlongY = false;
layout(constant_id = 1) const int kReach = 2;  // texels
layout(set = 1, binding = 0, scalar) uniform Block { WashUniforms u; };
layout(set = 1, binding = kWashBlurred) uniform sampler2DArray density;

vec4 shade(ivec2 pixel, int layer) {
  float deviation = max(0.5 * u.edgeWidth / float(kPigmentScale), 0.35);
  ivec2 last = textureSize(density, 0).xy - 1;
  vec4 sum = vec4(0.0);
  float weights = 0.0;
  for (int i = -kReach; i <= kReach; ++i) {
    float weight = exp(-0.5 * float(i * i) / (deviation * deviation));
    ivec2 at = clamp(pixel + (kAlongY ? ivec2(0, i) : ivec2(i, 0)), ivec2(0), last);
    sum += weight * texelFetch(density, ivec3(at, layer), 0);
    weights += weight;
  }
  return sum / weights;
}

#include "../../../shading/image_pass.glsl"
