#version 460
// Surfaces with holes: masked and blended ones.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "../../shading/light_space.glsl"
#include "../../shading/material.glsl"
#include "shadow_map.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 2) in vec2 inUv0;
layout(location = 3) in vec2 inUv1;
layout(location = 4) in vec4 inColor;
layout(location = 0) out vec3 outUvAlpha;

void main() {
  gl_Position = shadowMapPosition(inPosition);
  outUvAlpha = vec3(baseUv(inUv0, inUv1), inColor.a);
}
