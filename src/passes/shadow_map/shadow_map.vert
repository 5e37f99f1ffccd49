#version 460
// Surfaces with holes: masked and blended ones.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "../../shading/light_space.glsl"
#include "shadow_map.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 2) in vec2 inUv0;
layout(location = 3) in vec2 inUv1;
layout(location = 4) in vec4 inColor;
layout(location = 0) out vec2 outUv0;
layout(location = 1) out vec2 outUv1;
layout(location = 2) out float outAlpha;
layout(location = 3) flat out uint outMaterial;

void main() {
  gl_Position = shadowMapPosition(inPosition);
  outUv0 = inUv0;
  outUv1 = inUv1;
  outAlpha = inColor.a;
  outMaterial = objects[gl_InstanceIndex].material;
}
