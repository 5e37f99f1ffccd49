#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "../../shading/material.glsl"
#include "../../shading/view_index.glsl"

layout(constant_id = kTexturedId) const int kTextured = 0;

#ifdef TRANSPARENT
layout(location = 11) in uint inPart;
layout(location = 11) flat out uint outPart;
layout(location = 1) in vec2 inNormal;
layout(location = 9) out vec3 outWorld;
layout(location = 10) out vec3 outNormal;
#endif
layout(location = 0) in vec3 inPosition;
layout(location = 2) in vec2 inUv0;
layout(location = 3) in vec2 inUv1;
layout(location = 4) in vec4 inColor;

layout(location = 0) out vec2 outUv;
layout(location = 1) out vec4 outColor;

void main() {
  gl_Position = VIEW_FIELD(worldToClip, viewIndex()) * vec4(inPosition, 1.0);
#ifdef TRANSPARENT
  outPart = parts[inPart].known;
  materialIndex = materialOf(outPart);
  if (!isOfGroup(outPart)) gl_Position = kNowhere;
  if (kFades) {
    outWorld = inPosition;
    outNormal = decodeNormal(inNormal);
  }
#endif
  outUv = kTextured != 0 ? baseUv(inUv0, inUv1) : vec2(0.0);
  outColor = material.baseColor * inColor;
}
