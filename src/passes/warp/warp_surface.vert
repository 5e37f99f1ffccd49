#version 460
// The inflated surface: each vertex moves outward along its screen-space projected normal (paper 000, section 4.1).
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "../../shading/material.glsl"
#include "../../shading/metatexture.glsl"
#include "../../shading/surface_tangents.glsl"
#include "../../shading/view_index.glsl"
#include "warp.glsl"

layout(constant_id = kTangentsId) const int kTangents = 0;

layout(constant_id = kAlphaModeId) const int kAlphaMode = 0;

layout(location = 0) in vec3 inPosition;
layout(location = 2) in vec2 inUv0;
layout(location = 3) in vec2 inUv1;
layout(location = 4) in vec4 inColor;
layout(location = 5) in vec3 inDPdu;
layout(location = 6) in vec2 inSmoothNormal;
layout(location = 7) in vec3 inDPdv;
layout(location = 8) in vec2 inPatternUv;
layout(location = 9) in float inWarpScale;

layout(location = 0) out vec3 outUvScale;    // pattern uv; the vertex's own share of the amount
layout(location = 1) out vec3 outTangentU;
layout(location = 2) out vec3 outTangentV;
layout(location = 3) out vec3 outBaseUvAlpha;
layout(location = 4) flat out uint outCode;  // the high bits of target 1
layout(location = 5) out vec3 outPoint;

void main() {
  mat4 worldToClip = VIEW_FIELD(worldToClip, viewIndex());
  vec4 clip = worldToClip * vec4(inPosition, 1.0);

  // Outward on the screen, in pixels per metre. Its length tells how far the normal is turned from the viewer:
  // vertices that face the viewer stay, since their direction on the screen means nothing.
  vec3 normal = decodeNormal(inSmoothNormal);
  vec4 normalClip = worldToClip * vec4(normal, 0.0);
  vec2 outward = (normalClip.xy - clip.xy / clip.w * normalClip.w) / clip.w * 0.5 * frame.imageSize;
  float pixelsPerMetre = 0.5 * frame.imageSize.y / (VIEW_FIELD(ndcToEyeRay, viewIndex()).y * clip.w);
  float size = length(outward);
  float turned = smoothstep(0.05, 0.35, abs(size / pixelsPerMetre));
  if (clip.w > 0.0 && size > 0.0)
    clip.xy += outward / size * warp.inflation * inWarpScale * turned / (0.5 * frame.imageSize) * clip.w;
  gl_Position = clip;

  mat4 tangentClip = tangentView(kTangents, worldToClip);
  outUvScale = vec3(inPatternUv + objects[gl_InstanceIndex].patternShift, inWarpScale);
  outTangentU = tangentToClip(tangentClip, inDPdu);
  outTangentV = tangentToClip(tangentClip, inDPdv);
  if (kViewCount > 1) outPoint = pointInTangentView(kTangents, worldToClip, inPosition);
  ObjectData object = objects[gl_InstanceIndex];
  outCode = 4u * uint(object.influences == 0u ? warp.setup : warp.characterSetup) + object.wraps;
  if (kAlphaMode != 0) outBaseUvAlpha = vec3(baseUv(inUv0, inUv1), inColor.a);
}
