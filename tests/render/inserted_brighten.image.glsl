#version 460
// For the test of knobs from outside: the picture so far, brighter.
#extension GL_GOOGLE_include_directive : require
#include "../../src/shading/frame.glsl"

struct BrightenParams {
#include "inserted_brighten.params"
};

layout(set = 1, binding = 0, scalar) uniform Block { BrightenParams knobs; };
layout(set = 1, binding = 1) uniform sampler2DArray source;

vec4 shade(ivec2 pixel, int layer) {
  return texelFetch(source, ivec3(pixel, layer), 0) * vec4(vec3(knobs.by), 1.0);
}

#include "../../src/shading/image_pass.glsl"
