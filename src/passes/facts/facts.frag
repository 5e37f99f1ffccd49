#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_multiview : require
#include "../../shading/frame.glsl"
#include "../../shading/alpha.glsl"
#include "../../shading/metatexture.glsl"

layout(constant_id = 0) const int kAlphaMode = 0;
layout(set = 1, binding = 0, scalar) readonly buffer MetaTextureBlock { MetaTextureParams metaTextureParams[]; };
layout(set = 2, binding = 0) uniform sampler2D baseTexture;

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
  ObjectData object = objects[inObject];
  if (kAlphaMode != 0) {
    MaterialData material = materials[object.material];
    discardHoles(material, material.baseColor.a * inBaseUvAlpha.z * texture(baseTexture, inBaseUvAlpha.xy).a,
                 kAlphaMode);
  }
  float w = 1.0 / gl_FragCoord.w;
  vec2 ndc = gl_FragCoord.xy / frame.imageSize * 2.0 - 1.0;
  vec2 gradU, gradV;
  uvGradients(projectTangent(inTangentU, ndc, w, frame.imageSize), projectTangent(inTangentV, ndc, w, frame.imageSize),
              gradU, gradV);
  MetaTextureParams meta = metaTextureParams[object.material];
  MetaTextureScale scale = metaTextureScale(gradU, gradV, meta.size * frame.pixelScale);

  outDepth = vec4(eyeDepth(gl_FragCoord.z, gl_ViewIndex));
  outPosition = vec4(inPosition, 1.0);
  outNormal = vec4(normalize(gl_FrontFacing ? inNormal : -inNormal), 1.0);
  outUv = vec4(inUv, 0.0, 1.0);
  outUvGradient = vec4(gradU, gradV);
  outMetaTexture = vec4(scale.exponent, 0.0, meta.contrast != 0 ? inversesqrt(metaTextureVariance(scale)) : 1.0);
  vec2 previous = (inPrevious.xy / inPrevious.w * 0.5 + 0.5) * frame.imageSize;
  outMotion = vec4(gl_FragCoord.xy - previous, 0.0, 1.0);
  outId = vec4(float(object.id));
}
