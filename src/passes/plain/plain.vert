#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_multiview : require
#include "../../shading/frame.glsl"

layout(constant_id = 1) const int kTextured = 0;

layout(location = 0) in vec3 inPosition;
layout(location = 2) in vec2 inUv0;
layout(location = 3) in vec2 inUv1;
layout(location = 4) in vec4 inColor;

layout(location = 0) out vec2 outUv;
layout(location = 1) out vec4 outColor;
layout(location = 2) flat out float outCutoff;

void main() {
  MaterialData material = materials[objects[gl_InstanceIndex].material];
  gl_Position = frame.views[gl_ViewIndex].worldToClip * vec4(inPosition, 1.0);
  vec3 uv = vec3(material.baseUvSet == 1 ? inUv1 : inUv0, 1.0);
  outUv = kTextured != 0 ? vec2(dot(material.baseUvRowU, uv), dot(material.baseUvRowV, uv)) : vec2(0.0);
  outColor = material.baseColor * inColor;
  outCutoff = material.alphaCutoff;
}
