#version 460
// The lens channel at a quarter of the size, and one axis of its glow. Light in the lens knows of no depth: it reaches over
// whatever lies beside the lamp. Nothing comes from outside the picture.
// In: the lens channel in G, premultiplied by coverage; later and out: in R.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "bloom.shared.h"

layout(constant_id = 0) const int kReach = 0;  // texels; 0: the step to a quarter of the size
layout(set = 1, binding = 0, scalar) uniform Block { BloomStep bloomStep; };
layout(set = 1, binding = kBloomSource) uniform sampler2DArray source;

vec4 shade(ivec2 pixel, int layer) {
  float sum = 0.0;
  ivec2 size = textureSize(source, 0).xy;
  if (kReach == 0) {
    // Each of four places is the mean of four texels.
    for (int i = 0; i < 4; ++i)
      sum += 0.25 * textureLod(source, vec3(vec2(4 * pixel + 1 + 2 * ivec2(i & 1, i >> 1)) / vec2(size), layer), 0.0).g;
  }
  for (int i = kReach == 0 ? 1 : -kReach; i <= kReach; ++i) {
    ivec2 at = pixel + i * bloomStep.axis;
    bool isInside = all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, size));
    sum += float(isInside) * bloomStep.weights[abs(i)] * texelFetch(source, ivec3(clamp(at, ivec2(0), size - 1), layer), 0).r;
  }
  return vec4(sum, 0.0, 0.0, 0.0);
}

#include "../../shading/image_pass.glsl"
