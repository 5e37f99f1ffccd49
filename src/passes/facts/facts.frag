#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "../../shading/material.glsl"
#include "../../shading/metatexture.glsl"
#include "../../shading/view_index.glsl"

layout(constant_id = 0) const int kAlphaMode = 0;
layout(set = 2, binding = 0, scalar) uniform MetaTextureBlock { MetaTextureParams meta; };

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec2 inUv;
layout(location = 3) in vec3 inTangentU;
layout(location = 4) in vec3 inTangentV;
layout(location = 5) in vec4 inPrevious;
layout(location = 6) flat in uint inObject;
layout(location = 7) in vec3 inBaseUvAlpha;

layout(location = 0) out vec4 outDepth;
layout(location = 1) out vec4 outPosition;
layout(location = 2) out vec4 outNormal;
layout(location = 3) out vec4 outUv;
layout(location = 4) out vec4 outUvGradient;
layout(location = 5) out vec4 outMetaTexture;
layout(location = 6) out vec4 outMotion;
layout(location = 7) out vec4 outId;

void main() {
  if (kAlphaMode != 0 && isHole(inBaseUvAlpha.xy, inBaseUvAlpha.z, kAlphaMode)) discard;
  float w = 1.0 / gl_FragCoord.w;
  vec2 ndc = gl_FragCoord.xy / frame.imageSize * 2.0 - 1.0;
  vec2 dSdu = projectTangent(inTangentU, ndc, w, frame.imageSize);
  vec2 dSdv = projectTangent(inTangentV, ndc, w, frame.imageSize);
  vec2 gradU, gradV;
  uvGradients(dSdu, dSdv, gradU, gradV);
  MetaTextureScale scale = metaTextureScale(gradU, gradV, dSdu, dSdv, meta.size * frame.pixelScale);

  outDepth = vec4(eyeDepth(gl_FragCoord.z, viewIndex()));
  outPosition = vec4(inPosition, 1.0);
  outNormal = vec4(normalize(gl_FrontFacing ? inNormal : -inNormal), 1.0);
  outUv = vec4(inUv, 0.0, 1.0);
  outUvGradient = vec4(gradU, gradV);
  outMetaTexture = vec4(scale.exponent, 0.0, meta.contrast != 0 ? inversesqrt(metaTextureVariance(scale)) : 1.0);
  vec2 previous = (inPrevious.xy / inPrevious.w * 0.5 + 0.5) * frame.imageSize;
  outMotion = vec4(gl_FragCoord.xy - previous, 0.0, 1.0);
  outId = vec4(float(objects[inObject].id));
}
