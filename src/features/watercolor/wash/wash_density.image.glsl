#version 460
// How much pigment the picture has, at a quarter of the size: what it keeps back of the light that the paper would give
// back, as a density by channel.
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/frame.glsl"
#include "../watercolor.shared.h"
#include "wash.glsl"

layout(set = 1, binding = 0, scalar) uniform Block { WashUniforms u; };
layout(set = 1, binding = kWashPicture) uniform sampler2DArray soFar;

vec4 shade(ivec2 pixel, int layer) {
  // The mean of four, each of four.
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 4; ++i) {
    vec2 at = vec2(pixel * kPigmentScale) + vec2(i & 1, i >> 1) * 2.0 + 1.0;
    vec4 color = textureLod(soFar, vec3(at / frame.imageSize, layer), 0.0);
    sum += vec4(densityOf(onPaper(color, u.white), u.white), 1.0);
  }
  return 0.25 * sum;
}

#include "../../../shading/image_pass.glsl"
