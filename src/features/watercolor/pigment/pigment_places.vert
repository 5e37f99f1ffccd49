#version 460
// Which object is seen where, at the pigment's size.
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/frame.glsl"
#include "../../../shading/material.glsl"
#include "../../../shading/view_index.glsl"

layout(constant_id = kAlphaModeId) const int kAlphaMode = 0;

layout(location = 0) in vec3 inPosition;
layout(location = 2) in vec2 inUv0;
layout(location = 3) in vec2 inUv1;
layout(location = 4) in vec4 inColor;

layout(location = 0) flat out float outObject;
layout(location = 1) out vec3 outBaseUvAlpha;

void main() {
  gl_Position = VIEW_FIELD(worldToClip, viewIndex()) * vec4(inPosition, 1.0);
  outObject = float(objects[gl_InstanceIndex].id) + 1.0;
  if (kAlphaMode != 0) outBaseUvAlpha = vec3(baseUv(inUv0, inUv1), inColor.a);
}
