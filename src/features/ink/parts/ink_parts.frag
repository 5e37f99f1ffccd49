#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/cutouts.glsl"
#include "../../../shading/frame.glsl"
#include "../../../shading/material.glsl"
#include "../../../shading/view_index.glsl"

layout(constant_id = kAlphaModeId) const int kAlphaMode = 0;

layout(location = 0) flat in vec2 inPartAndObject;
layout(location = 1) in vec3 inBaseUvAlpha;

layout(location = 0) out vec4 outPart;

void main() {
  if (kAlphaMode == kCut ? isCutOut(viewIndex()) : kAlphaMode != 0 && isHole(inBaseUvAlpha.xy, inBaseUvAlpha.z, kAlphaMode))
    discard;
  outPart = vec4(inPartAndObject, float(kAlphaMode != 0), eyeDepth(gl_FragCoord.z, viewIndex()));
}
