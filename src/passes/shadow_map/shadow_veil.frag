#version 460
// What a blended surface of less than half opacity holds back of the light; more opaque ones are in the shadow map.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "../../shading/material.glsl"

layout(location = 0) in vec3 inUvAlpha;
layout(location = 0) out vec4 outVeil;

// What holds back less has no shadow.
const float kLeast = 0.02;

void main() {
  float alpha = inUvAlpha.z * material.baseColor.a * texture(baseTexture, inUvAlpha.xy).a;
  if (alpha < kLeast || alpha >= 0.5) discard;
  outVeil = vec4(1.0 - gl_FragCoord.z, alpha, 0.0, 1.0);
}
