// Descriptor set 1 of geometry passes: the material of what is being drawn. It changes between draws, not within one,
// which lets drivers load it once and not for every fragment.
#ifndef SCUMBLE_MATERIAL_GLSL
#define SCUMBLE_MATERIAL_GLSL

#ifdef TRANSPARENT
#include "transparent.glsl"
#else
layout(set = 1, binding = 0, scalar) uniform MaterialBlock { MaterialData material; };
layout(set = 1, binding = 1) uniform sampler2D baseTexture;
layout(set = 1, binding = 2) uniform sampler2D emissiveTexture;
// Whole sets of colours for light and for shadow, where the material has them; at the coordinates of baseTexture.
layout(set = 1, binding = 3) uniform sampler2D litTexture;
layout(set = 1, binding = 4) uniform sampler2D shadowedTexture;
#endif

vec2 baseUv(vec2 uv0, vec2 uv1) {
  vec3 uv = vec3(material.baseUvSet == 1 ? uv1 : uv0, 1.0);
  return vec2(dot(material.baseUvRowU, uv), dot(material.baseUvRowV, uv));
}

vec2 emissiveUv(vec2 uv0, vec2 uv1) {
  vec3 uv = vec3(material.emissiveUvSet == 1 ? uv1 : uv0, 1.0);
  return vec2(dot(material.emissiveUvRowU, uv), dot(material.emissiveUvRowV, uv));
}

#ifndef TRANSPARENT
// For passes that only need to know where a surface is: whether a masked one (mode 1) has a hole there, or a blended one
// (mode 2) is nearly not there.
bool isHole(float alpha, int alphaMode) { return alpha < (alphaMode == 1 ? material.alphaCutoff : 0.5); }
bool isHole(vec2 uv, float vertexAlpha, int alphaMode) {
  return isHole(vertexAlpha * material.baseColor.a * texture(baseTexture, uv).a, alphaMode);
}
#endif
#endif
