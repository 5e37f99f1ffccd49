#version 460
// Warp vectors, attached to the surface by MetaTexture (paper 000, section 4).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_multiview : require
#include "../../shading/frame.glsl"
#include "../../shading/material.glsl"
#include "../../shading/metatexture.glsl"
#include "warp.glsl"

layout(constant_id = 0) const int kAlphaMode = 0;
layout(set = 2, binding = 2) uniform sampler2D noise;

layout(location = 0) in vec2 inUv;
layout(location = 1) in vec3 inTangentU;
layout(location = 2) in vec3 inTangentV;
layout(location = 3) in vec3 inBaseUvAlpha;
layout(location = 0) out vec4 outWarp;

void main() {
  if (kAlphaMode != 0 && isHole(inBaseUvAlpha.xy, inBaseUvAlpha.z, kAlphaMode)) discard;
  float w = 1.0 / gl_FragCoord.w;
  vec2 ndc = gl_FragCoord.xy / frame.imageSize * 2.0 - 1.0;
  vec2 dSdu = projectTangent(inTangentU, ndc, w, frame.imageSize);
  vec2 dSdv = projectTangent(inTangentV, ndc, w, frame.imageSize);
  vec2 gradU, gradV;
  uvGradients(dSdu, dSdv, gradU, gradV);
  MetaTextureScale scale = metaTextureScale(gradU, gradV, dSdu, dSdv, meta.size * frame.pixelScale);
  vec2 vector = metaTexture(noise, inUv, scale, vec4(0.5), float(meta.contrast), frame.patternShift).xy * 2.0 - 1.0;

  // Camera roll (section 4.3): the frame of reference follows the gradient of u, so the pattern sticks to the surface.
  float lengthU = length(gradU);
  vec2 axis = lengthU > 0.0 ? gradU / lengthU : vec2(1.0, 0.0);
  vector = vec2(axis.x * vector.x - axis.y * vector.y, axis.y * vector.x + axis.x * vector.y);

  float depth = eyeDepth(gl_FragCoord.z, gl_ViewIndex);
  float far = warp.distance * depth;  // eq. 26
  vector *= warp.amount * frame.pixelScale / (1.0 + far * far);
  outWarp = vec4(vector, 1.0, min(depth, 60000.0));
}
