#version 460
// For the test of inserted passes: the picture so far, to a power.
#extension GL_GOOGLE_include_directive : require
#include "../../src/shading/frame.glsl"

layout(set = 1, binding = 0, scalar) uniform Block { float power; };
layout(set = 1, binding = 1) uniform sampler2DArray source;

vec4 shade(ivec2 pixel, int layer) {
  vec4 color = texelFetch(source, ivec3(pixel, layer), 0);
  return vec4(pow(max(color.rgb, 0.0), vec3(power)), color.a);
}

#include "../../src/shading/image_pass.glsl"
