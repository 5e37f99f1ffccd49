#version 460
// Everything that varies slowly over a triangle is computed here: fragments of small triangles are many.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/draws.shared.h"
#include "../../shading/frame.glsl"
#include "../../shading/light_space.glsl"
#include "../../shading/material.glsl"
#include "../../shading/metatexture.glsl"
#include "../../shading/surface_tangents.glsl"
#include "../../shading/view_index.glsl"
#include "surface.glsl"

#ifndef TRANSPARENT
layout(set = 2, binding = kSurfaceObjects, scalar) readonly buffer Drawn { DrawnObject drawn[]; };
layout(location = 12) flat out uint outHidesBacks;
#endif

layout(constant_id = kVariedId) const int kVaried = 0;    // colours vary: vertex colours or textures
layout(constant_id = kTexturedId) const int kTextured = 0;
layout(constant_id = kPassId) const int kOptions = 0;  // 1: only what lies behind; 2: there are point and spot lights; 4: highlights

#ifdef TRANSPARENT
layout(location = 11) in uint inPart;
layout(location = 11) flat out uint outPart;
#endif

#ifdef PAINTED  // the look paints a texture on it
layout(constant_id = kTangentsId) const int kTangents = 0;
layout(location = 5) in vec3 inDPdu;
layout(location = 7) in vec3 inDPdv;
layout(location = 8) in vec2 inPatternUv;
layout(location = 4) out vec2 outPatternUv;
layout(location = 5) out vec3 outTangentU;
layout(location = 6) out vec3 outTangentV;
layout(location = 7) out vec3 outPoint;
layout(location = 8) flat out uint outWraps;
#endif

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec2 inNormal;
layout(location = 2) in vec2 inUv0;
layout(location = 3) in vec2 inUv1;
layout(location = 4) in vec4 inColor;
layout(location = 6) in vec2 inSmoothNormal;
layout(location = 12) in vec4 inIndirect;

layout(location = 0) out vec3 outLightSpace;  // the sigmoid's argument, and depth from the light
// Towards the light, and upwards: cosines of the front side; and towards the light as the form has it.
layout(location = 1) out vec3 outFacing;
layout(location = 2) out vec4 outColor;
layout(location = 3) out vec4 outUvs;
layout(location = 9) out vec3 outWorld;
layout(location = 10) out vec3 outNormal;
layout(location = 13) out vec4 outIndirect;  // as indirectLight() has it

void main() {
#ifdef TRANSPARENT
  uint index = parts[inPart].object;
  outPart = parts[inPart].known;
  materialIndex = materialOf(outPart);
#else
  uint index = gl_InstanceIndex;
#endif
  mat4 worldToClip = VIEW_FIELD(worldToClip, viewIndex());
  gl_Position = worldToClip * vec4(inPosition, 1.0);
#ifdef TRANSPARENT
  if (!isOfGroup(outPart)) gl_Position = kNowhere;
#endif
  vec3 normal = decodeNormal(inNormal);
  float lambert = dot(normal, frame.toLight);

  // Two and a half texels along the normal, on the side that the light can reach, keep a surface from shading itself
  // wherever the map is coarse: one for what the sigmoid bends, the rest for the map's filter. What is drawn with fewer
  // triangles than it casts shadows with may lie in its own.
  vec3 p = (frame.worldToLight * vec4(inPosition, 1.0)).xyz;
  vec2 texel = frame.shadowTexel * frame.lightToWorldScale.xy / lightSpaceMagnification(sigmoidArgument(p.xy));
  float coarse = max(texel.x, texel.y);
  float lift = 2.5 * coarse;
#ifndef TRANSPARENT
  lift += drawn[index].sunken;
#endif
  p += mat3(frame.worldToLight) * normal * (lambert < 0.0 ? -lift : lift);
  outLightSpace = vec3(sigmoidArgument(p.xy), p.z - 0.5 * coarse / frame.lightToWorldScale.z);

  // Facets of a round form count as that form; folds as deep as a box's do not.
  vec3 smoothNormal = decodeNormal(inSmoothNormal);
  vec3 form = mix(normal, smoothNormal, smoothstep(0.7, 0.85, dot(normal, smoothNormal)));
  outFacing = vec3(lambert, normal.y, dot(normalize(form), frame.toLight));
  if ((kOptions & 6) != 0) {
    outWorld = inPosition;
    outNormal = normal;
  }
#ifndef TRANSPARENT
  if ((kOptions & 1) != 0) outHidesBacks = drawn[index].hidesBacks;
#endif
  if (kVaried != 0) outColor = inColor;
  if ((kOptions & kSurfaceIndirect) != 0) outIndirect = inIndirect;
  if ((kOptions & kSurfaceIndirectColors) != 0) {
    // White is all of the light.
    float most = max(inColor.r, max(inColor.g, inColor.b));
    outIndirect = vec4(sqrt(inColor.rgb / max(most, 1e-3)), 1.0 - sqrt(most));
    if (kVaried != 0) outColor = vec4(1.0, 1.0, 1.0, inColor.a);
  }
#ifdef PAINTED
  mat4 tangentClip = tangentView(kTangents, worldToClip);
  outPatternUv = inPatternUv + objects[index].patternShift;
  outTangentU = tangentToClip(tangentClip, inDPdu);
  outTangentV = tangentToClip(tangentClip, inDPdv);
  outPoint = pointInTangentView(kTangents, worldToClip, inPosition);
  outWraps = objects[index].wraps;
#endif
  if (kTextured != 0) outUvs = vec4(baseUv(inUv0, inUv1), emissiveUv(inUv0, inUv1));
}
