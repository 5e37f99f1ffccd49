#version 460
// Only for surfaces with holes.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "../../shading/alpha.glsl"

layout(constant_id = 0) const int kAlphaMode = 0;
layout(set = 1, binding = 0) uniform sampler2D baseTexture;

layout(location = 0) in vec2 inUv0;
layout(location = 1) in vec2 inUv1;
layout(location = 2) in float inAlpha;
layout(location = 3) flat in uint inMaterial;

void main() {
  MaterialData material = materials[inMaterial];
  float alpha = inAlpha * material.baseColor.a * texture(baseTexture, baseUv(material, inUv0, inUv1)).a;
  discardHoles(material, alpha, kAlphaMode);
}
