#version 460
// Target 0: bits of pattern u and v; dS/du and dS/dv in pixels per unit, each as two bfloat16.
// Target 1, two numbers each: height of the wave in reliefs and Jacobian, as halfs; x and z of the normal; cover of
// foam by decorations, up to 2, and how far they suppress strokes; nothing.
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/cutouts.glsl"
#include "../../../shading/frame.glsl"
#include "../../../shading/metatexture.glsl"
#include "../../../shading/surface_tangents_at_pixel.glsl"
#include "../../../shading/view_index.glsl"

layout(constant_id = kAlphaModeId) const int kAlphaMode = 0;
layout(constant_id = kPassId) const int kTangents = 0;  // options of surface_tangents.shared.h

layout(location = 0) in vec2 inPatternUv;
layout(location = 1) in vec3 inTangentU;
layout(location = 2) in vec3 inTangentV;
layout(location = 3) in vec3 inPoint;
layout(location = 4) in vec4 inWave;
layout(location = 5) in vec2 inDecorated;
layout(location = 0) out uvec4 outPattern;
layout(location = 1) out uvec4 outWave;

void main() {
  vec2 dSdu, dSdv;
  surfaceTangents(kTangents, inTangentU, inTangentV, inPoint, inPatternUv, viewIndex(), dSdu, dSdv);
  if (kAlphaMode == kCut && isCutOut(viewIndex())) discard;
  outPattern = uvec4(floatBitsToUint(inPatternUv), packBfloat(dSdu), packBfloat(dSdv));
  outWave = uvec4(packHalf2x16(inWave.xy), packSnorm2x16(inWave.zw),
                  packUnorm2x16(inDecorated * vec2(0.5, 1.0)), 0u);
}
