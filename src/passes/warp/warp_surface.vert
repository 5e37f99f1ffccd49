#version 460
// The inflated surface: each vertex moves outward along its screen-space projected normal (paper 000, section 4.1).
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "../../shading/material.glsl"
#include "../../shading/metatexture.glsl"
#include "../../shading/view_index.glsl"
#include "warp.glsl"

layout(constant_id = 0) const int kAlphaMode = 0;

layout(location = 0) in vec3 inPosition;
layout(location = 2) in vec2 inUv0;
layout(location = 3) in vec2 inUv1;
layout(location = 4) in vec4 inColor;
layout(location = 5) in vec3 inDPdu;
layout(location = 6) in vec2 inSmoothNormal;
layout(location = 7) in vec3 inDPdv;
layout(location = 8) in vec2 inPatternUv;

layout(location = 0) out vec2 outUv;
layout(location = 1) out vec3 outTangentU;  // clip-space x, y, w of dP/du
layout(location = 2) out vec3 outTangentV;
layout(location = 3) out vec3 outBaseUvAlpha;
layout(location = 4) flat out vec2 outSizeContrast;  // as target 1 has them

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
  if (clip.w > 0.0 && size > 0.0) {
    float pixels = warp.inflation * frame.pixelScale * turned;
    clip.xy += outward / size * pixels / (0.5 * frame.imageSize) * clip.w;
  }
  gl_Position = clip;

  outSizeContrast = vec2(log2(meta.size * frame.pixelScale) / 16.0, float(meta.contrast));
  outUv = inPatternUv;
  vec3 toPixels = vec3(0.5 * frame.imageSize, 1.0);
  outTangentU = toPixels * (worldToClip * vec4(inDPdu, 0.0)).xyw;
  outTangentV = toPixels * (worldToClip * vec4(inDPdv, 0.0)).xyw;
  if (kAlphaMode != 0) outBaseUvAlpha = vec3(baseUv(inUv0, inUv1), inColor.a);
}
