#version 460
// Only for surfaces with holes.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "../../shading/material.glsl"

layout(constant_id = kAlphaModeId) const int kAlphaMode = 0;
layout(location = 0) in vec3 inUvAlpha;

void main() {
  if (isHole(inUvAlpha.xy, inUvAlpha.z, kAlphaMode)) discard;
}
