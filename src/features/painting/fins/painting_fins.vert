#version 460
// Layers of paint: fins and coats.
#extension GL_GOOGLE_include_directive : require
#define TRANSPARENT
#include "../../../shading/frame.glsl"
#include "../../../shading/material.glsl"
#include "../../../shading/view_index.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec2 inNormal;
layout(location = 2) in vec2 inUv0;
layout(location = 3) in vec2 inUv1;
layout(location = 4) in vec4 inColor;
layout(location = 11) in uint inPart;

layout(location = 0) out vec2 outUv;
layout(location = 1) out vec4 outColor;
layout(location = 2) out vec3 outWorld;
layout(location = 3) out vec3 outNormal;
layout(location = 4) flat out vec2 outFade;
layout(location = 5) flat out ivec3 outSides;  // its texture; 1: the front is what faces backwards; 1: back faces are not seen

void main() {
  uint known = parts[inPart].known;
  materialIndex = materialOf(known);
  gl_Position = isOfGroup(known) ? VIEW_FIELD(worldToClip, viewIndex()) * vec4(inPosition, 1.0) : kNowhere;
  outUv = baseUv(inUv0, inUv1);
  outColor = material.baseColor * inColor;
  outWorld = inPosition;
  outNormal = decodeNormal(inNormal);
  outFade = materialRows[materialIndex].fade;
  outSides = ivec3(materialRows[materialIndex].slots.x, known & 1u, materialRows[materialIndex].single);
}
