#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../shading/cutouts.glsl"
#include "../../shading/frame.glsl"
#include "../../shading/material.glsl"
#include "../../shading/metatexture.glsl"
#include "../../shading/surface_tangents_at_pixel.glsl"
#include "../../shading/view_index.glsl"
#include "facts.glsl"

layout(constant_id = kAlphaModeId) const int kAlphaMode = 0;
layout(constant_id = kFeaturesId) const int kFeatures = 0;
layout(constant_id = kTangentsId) const int kTangents = 0;

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec2 inUv;
layout(location = 3) in vec3 inTangentU;
layout(location = 4) in vec3 inTangentV;
layout(location = 5) in vec4 inPrevious;
layout(location = 6) flat in uint inObject;
layout(location = 7) in vec3 inBaseUvAlpha;
layout(location = 8) in vec3 inMetaTangentU;
layout(location = 9) in vec3 inMetaTangentV;
layout(location = 10) in vec3 inMetaPoint;

layout(location = 0) out vec4 outDepth;
layout(location = 1) out vec4 outPosition;
layout(location = 2) out vec4 outNormal;
layout(location = 3) out vec4 outUv;
layout(location = 4) out vec4 outUvGradient;
layout(location = 5) out vec4 outMetaTexture;
layout(location = 6) out vec4 outMotion;
layout(location = 7) out vec4 outId;

void main() {
  vec2 metaU, metaV;
  surfaceTangents(kTangents, inMetaTangentU, inMetaTangentV, inMetaPoint, inUv, viewIndex(), metaU, metaV);
  if (kAlphaMode == kCut ? isCutOut(viewIndex()) : kAlphaMode != 0 && isHole(inBaseUvAlpha.xy, inBaseUvAlpha.z, kAlphaMode))
    discard;
  float w = 1.0 / gl_FragCoord.w;
  vec2 ndc = gl_FragCoord.xy / frame.imageSize * 2.0 - 1.0;
  vec2 gradU, gradV;
  metaTextureInvert(metaTextureProject(inTangentU, ndc, w, frame.imageSize),
                    metaTextureProject(inTangentV, ndc, w, frame.imageSize), gradU, gradV);
  MetaTexture meta = facts.meta;
  meta.features = kFeatures;
  MetaTextureChoice chosen = metaTextureChoose(meta, metaU, metaV, 1.0);

  outDepth = vec4(eyeDepth(gl_FragCoord.z, viewIndex()));
  outPosition = vec4(inPosition + frame.positionShift, 1.0);
  outNormal = vec4(normalize(gl_FrontFacing ? inNormal : -inNormal), 1.0);
  outUv = vec4(inUv, 0.0, 1.0);
  outUvGradient = vec4(gradU, gradV);
  outMetaTexture = vec4(metaTextureMeanExponent(chosen), chosen.q,
                        metaTextureGain(meta, metaTextureVariance(meta, chosen)));
  vec2 previous = (inPrevious.xy / inPrevious.w * 0.5 + 0.5) * frame.imageSize;
  // The third is the depth buffer's, for targets that are normalised.
  outMotion = vec4(gl_FragCoord.xy - previous, gl_FragCoord.z - inPrevious.z / inPrevious.w, 1.0);
  outId = vec4(float(objects[inObject].id), facts.number, 0.0, 1.0);
}
