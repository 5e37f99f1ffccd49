#version 460
// What MetaTexture needs to know of the inflated surface. The texture itself is evaluated by an image step, once a pixel:
// small triangles run their fragment shaders for many pixels that they do not cover.
//
// Target 0: bits of pattern u and v; dS/du and dS/dv in pixels per unit, each as two bfloat16 (a float's range, and a
//           precision of 0.4 percent, which is less than a hundredth of a blend).
// Target 1: the amount in pixels, as a half in the low bits; in the high ones 4 times the number of the material's setup,
//           plus how the mapping wraps (ObjectData). 0 where nothing is.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/cutouts.glsl"
#include "../../shading/frame.glsl"
#include "../../shading/material.glsl"
#include "../../shading/metatexture.glsl"
#include "../../shading/surface_tangents_at_pixel.glsl"
#include "../../shading/view_index.glsl"
#include "warp.glsl"
#include "warp.shared.h"

layout(constant_id = kAlphaModeId) const int kAlphaMode = 0;
layout(constant_id = kTangentsId) const int kTangents = 0;
layout(constant_id = kMaterialId) const int kOptions = 0;  // kWarpFades, kWarpFollows

layout(location = 0) in vec3 inUvScale;
layout(location = 1) in vec3 inTangentU;
layout(location = 2) in vec3 inTangentV;
layout(location = 3) in vec3 inBaseUvAlpha;
layout(location = 4) flat in uint inCode;
layout(location = 5) in vec3 inPoint;
layout(location = 0) out uvec4 outPattern;
layout(location = 1) out uint outKnobs;

void main() {
  vec2 byX = dFdx(inUvScale.xy), byY = dFdy(inUvScale.xy);
  vec2 dSdu, dSdv;
  surfaceTangents(kTangents, inTangentU, inTangentV, inPoint, inUvScale.xy, viewIndex(), dSdu, dSdv);
  if (kAlphaMode == kCut ? isCutOut(viewIndex()) : kAlphaMode != 0 && isHole(inBaseUvAlpha.xy, inBaseUvAlpha.z, kAlphaMode))
    discard;
  outPattern = uvec4(floatBitsToUint(inUvScale.xy), packBfloat(dSdu), packBfloat(dSdv));
  // Paper 000, eq. 26; FORMULAS 12: the distance has a scale.
  float amount = warp.amount;
  if ((kOptions & kWarpFades) != 0) {
    float far = warp.distance * eyeDepth(gl_FragCoord.z, viewIndex());
    amount = max(amount / (1.0 + far * far), warp.least);
  }
  amount *= inUvScale.z;
  // Tangents are a vertex's, and smooth; the mapping is each triangle's own. Where it runs faster than they say, the
  // pattern is finer than it should be; it is shallower there by as much, so that no tear is steeper than others.
  if ((kOptions & kWarpFollows) != 0) {
    float finer = sqrt(metaTextureStretch(dSdu * byX.x + dSdv * byX.y, dSdu * byY.x + dSdv * byY.y));
    if (finer > 1.5) amount *= 1.5 / finer;
  }
  outKnobs = packHalf2x16(vec2(amount, 0.0)) | inCode << 16;
}
