#version 460
// Objects' numbers, with the holes and the layers that the surface pass has.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/cutouts.glsl"
#include "../../shading/frame.glsl"
#include "../../shading/material.glsl"
#include "../../shading/view_index.glsl"
#include "matte.shared.h"

layout(constant_id = kAlphaModeId) const int kAlphaMode = 0;
layout(constant_id = kPassId) const int kBehind = 0;  // only what lies behind the first surface

layout(set = 2, binding = 0, scalar) uniform Block { MatteMaterial matte; };
layout(set = 2, binding = 1) uniform sampler2DArray firstDepth;

layout(location = 0) flat in float inObject;
layout(location = 1) in vec3 inBaseUvAlpha;
layout(location = 0) out float outObject;

void main() {
  if (kBehind != 0) {
    float first = texelFetch(firstDepth, ivec3(gl_FragCoord.xy, viewIndex()), 0).r;
    if (eyeDepth(gl_FragCoord.z, viewIndex()) < 1.005 * eyeDepth(first, viewIndex())) discard;
  }
  if (kAlphaMode == kCut && isCutOut(viewIndex())) discard;
  if (kAlphaMode == 1 || kAlphaMode == 2) {
    float alpha = material.baseColor.a * inBaseUvAlpha.z * texture(baseTexture, inBaseUvAlpha.xy, matte.simplify).a;
    if (isHole(alpha, kAlphaMode)) discard;
  }
  outObject = inObject;
}
