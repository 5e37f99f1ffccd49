#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "../../shading/material.glsl"
#include "../../shading/metatexture.glsl"
#include "../../shading/surface_tangents.glsl"
#include "../../shading/view_index.glsl"
#include "facts.glsl"

layout(constant_id = kTangentsId) const int kTangents = 0;

layout(constant_id = kAlphaModeId) const int kAlphaMode = 0;

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec2 inNormal;
layout(location = 2) in vec2 inUv0;
layout(location = 3) in vec2 inUv1;
layout(location = 4) in vec4 inColor;
layout(location = 5) in vec3 inDPdu;
layout(location = 7) in vec3 inDPdv;
layout(location = 8) in vec2 inPatternUv;
layout(location = 10) in vec3 inPreviousPosition;

layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outNormal;
layout(location = 2) out vec2 outUv;
layout(location = 3) out vec3 outTangentU;
layout(location = 4) out vec3 outTangentV;
layout(location = 5) out vec4 outPrevious;
layout(location = 6) flat out uint outObject;
layout(location = 7) out vec3 outBaseUvAlpha;
layout(location = 8) out vec3 outMetaTangentU;  // in the view that MetaTexture counts by
layout(location = 9) out vec3 outMetaTangentV;
layout(location = 10) out vec3 outMetaPoint;

void main() {
  mat4 worldToClip = VIEW_FIELD(worldToClip, viewIndex());
  gl_Position = worldToClip * vec4(inPosition, 1.0);
  outPosition = inPosition;
  outNormal = decodeNormal(inNormal);
  outUv = inPatternUv + objects[gl_InstanceIndex].patternShift;
  outTangentU = (worldToClip * vec4(inDPdu, 0.0)).xyw;
  outTangentV = (worldToClip * vec4(inDPdv, 0.0)).xyw;
  mat4 tangentClip = tangentView(kTangents, worldToClip);
  outMetaTangentU = tangentToClip(tangentClip, inDPdu);
  outMetaTangentV = tangentToClip(tangentClip, inDPdv);
  outMetaPoint = pointInTangentView(kTangents, worldToClip, inPosition);
  outPrevious = VIEW_FIELD(previousWorldToClip, viewIndex()) * vec4(inPreviousPosition, 1.0);
  outObject = gl_InstanceIndex;
  if (kAlphaMode != 0) outBaseUvAlpha = vec3(baseUv(inUv0, inUv1), inColor.a);
}
