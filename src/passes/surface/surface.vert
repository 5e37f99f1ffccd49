#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_multiview : require
#include "../../shading/frame.glsl"
#include "../../shading/material.glsl"

layout(constant_id = 1) const int kTextured = 0;

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec2 inNormal;
layout(location = 2) in vec2 inUv0;
layout(location = 3) in vec2 inUv1;
layout(location = 4) in vec4 inColor;
layout(location = 5) in vec3 inDPdu;
layout(location = 7) in vec3 inDPdv;
layout(location = 8) in vec2 inPatternUv;

layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outNormal;
layout(location = 2) out vec4 outColor;
layout(location = 3) out vec4 outUvs;
layout(location = 4) out vec3 outTangentU;
layout(location = 5) out vec3 outTangentV;
layout(location = 6) out vec2 outPatternUv;

void main() {
  ViewUniforms view = frame.views[gl_ViewIndex];
  gl_Position = view.worldToClip * vec4(inPosition, 1.0);
  outPosition = inPosition;
  outNormal = decodeNormal(inNormal);
  outColor = inColor;
  outPatternUv = inPatternUv;
  outTangentU = (view.worldToClip * vec4(inDPdu, 0.0)).xyw;
  outTangentV = (view.worldToClip * vec4(inDPdv, 0.0)).xyw;
  if (kTextured != 0) outUvs = vec4(baseUv(inUv0, inUv1), emissiveUv(inUv0, inUv1));
}
