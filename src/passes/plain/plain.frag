#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../shading/cutouts.glsl"
#include "../../shading/frame.glsl"
#define TRANSPARENT_TEXTURES
#include "../../shading/material.glsl"
#include "../../shading/view_index.glsl"

layout(constant_id = kAlphaModeId) const int kAlphaMode = 0;
layout(constant_id = kTexturedId) const int kTextured = 0;

#ifdef TRANSPARENT
layout(location = 11) flat in uint inPart;
layout(location = 9) in vec3 inWorld;
layout(location = 10) in vec3 inNormal;
#endif
layout(location = 0) in vec2 inUv;
layout(location = 1) in vec4 inColor;
layout(location = 0) out vec4 outColor;

void main() {
  vec4 color = inColor;
#ifdef TRANSPARENT
  materialIndex = materialOf(inPart);
  color *= sampleSlots(ivec4(materialRows[materialIndex].slots.x, -1, -1, -1), inUv, 0.0).values[0];
  if (isCulled(seesFront(inPart, gl_FrontFacing))) discard;
  if (kFades) color.a *= paintFade(materialRows[materialIndex].fade, inWorld, inNormal);
  outColor = color;
#else
  if (kTextured != 0) color *= texture(baseTexture, inUv);
  if (kAlphaMode == kCut && isCutOut(viewIndex())) discard;
  if (kAlphaMode == 1 && color.a < material.alphaCutoff) discard;
  outColor = vec4(color.rgb, 1.0);
#endif
}
