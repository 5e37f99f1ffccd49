#version 460
// The shadow channels and both colours of every surface in one geometry pass (FORMULAS 14): the colour pass then only
// mixes.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_multiview : require
#include "../../shading/frame.glsl"
#include "../../shading/color_map.glsl"
#include "../../shading/light_space.glsl"
#include "../../shading/material.glsl"
#include "../../shading/metatexture.glsl"
#include "surface.glsl"

layout(constant_id = 0) const int kAlphaMode = 0;  // 0 opaque, 1 masked, 2 blended
layout(constant_id = 1) const int kTextured = 0;

layout(set = 2, binding = 0, scalar) uniform ParamsBlock { SurfaceParams params; };
layout(set = 2, binding = 1, scalar) uniform SurfaceBlock { SurfaceUniforms surface; };
layout(set = 2, binding = 2) uniform sampler2DArrayShadow shadowMap;
layout(set = 2, binding = 3) uniform sampler2D knife;

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec4 inColor;
layout(location = 3) in vec4 inUvs;
layout(location = 4) in vec3 inTangentU;
layout(location = 5) in vec3 inTangentV;
layout(location = 6) in vec2 inPatternUv;

layout(location = 0) out vec4 outShadow;
layout(location = 1) out vec4 outLit;
layout(location = 2) out vec4 outShadowed;

// 1 where the key light reaches.
float lightReaches(vec3 position, vec3 normal, float lambert) {
  vec3 p = (frame.worldToLight * vec4(position, 1.0)).xyz;
  vec2 magnification = lightSpaceMagnification(p.xy, frame.shadowCenter, frame.shadowWarp);
  // A texel and a half along the normal keeps a surface from shading itself, wherever the map is coarse.
  vec2 texel = frame.shadowTexel * frame.lightToWorldScale.xy / magnification;
  float offset = 1.5 * max(texel.x, texel.y);
  p = (frame.worldToLight * vec4(position + normal * offset, 1.0)).xyz;
  if (any(greaterThan(abs(p.xy), vec2(1.0)))) return 1.0;
  vec2 uv = warpLightSpace(p.xy, frame.shadowCenter, frame.shadowWarp) * 0.5 + 0.5;
  float bias = 0.5 * max(texel.x, texel.y) / frame.lightToWorldScale.z;
  return texture(shadowMap, vec4(uv, 0.0, clamp(p.z - bias, 0.0, 1.0)));
}

void main() {
  // Albedo and alpha.
  vec4 albedo = material.baseColor * inColor;
  vec3 emissive = material.emissive;
  if (kTextured != 0) {
    albedo *= texture(baseTexture, inUvs.xy, params.simplify);
    emissive *= texture(emissiveTexture, inUvs.zw, params.simplify).rgb;
  }
  if (kAlphaMode == 1 && albedo.a < material.alphaCutoff) discard;
  float alpha = kAlphaMode == 2 ? albedo.a : 1.0;

  // Red: Lambert times cast shadow, steepened around the terminator.
  vec3 normal = normalize(gl_FrontFacing ? inNormal : -inNormal);
  float lambert = dot(normal, frame.toLight);
  float light = clamp(0.5 + (lambert - surface.terminator) * surface.terminatorSharpness, 0.0, 1.0);
  float reaches = lightReaches(inPosition, normal, lambert);
  light = material.unlit != 0 ? 1.0 : light * reaches;

  // Green: lens.
  float lens = clamp(dot(emissive, vec3(0.2126, 0.7152, 0.0722)) * params.lens, 0.0, 1.0);

  // Blue: the breakup map, only where the surface is oblique to the light and the light reaches it.
  float w = 1.0 / gl_FragCoord.w;
  vec2 ndc = gl_FragCoord.xy / frame.imageSize * 2.0 - 1.0;
  vec2 dSdu = projectTangent(inTangentU, ndc, w, frame.imageSize);
  vec2 dSdv = projectTangent(inTangentV, ndc, w, frame.imageSize);
  vec2 gradU, gradV;
  uvGradients(dSdu, dSdv, gradU, gradV);
  MetaTextureScale scale = metaTextureScale(gradU, gradV, dSdu, dSdv, params.indicationSize * frame.pixelScale);
  float marks = metaTexture(knife, inPatternUv, scale, vec4(0.5), 1.0, frame.patternShift).x;
  float oblique = 1.0 - smoothstep(0.0, params.indicationWidth, abs(lambert - surface.terminator));
  float breakup = material.unlit != 0 ? 0.0 : clamp(marks, 0.0, 1.0) * oblique * reaches * params.indication;

  // Colours in light and in shadow.
  vec3 root = sqrt(clamp(albedo.rgb, 0.0, 1.0));
  vec3 lit = applyColorMap(material.lit, root);
  vec3 shadowed = applyColorMap(material.shadowed, root);
  shadowed = mix(shadowed, material.shadowedColor, material.hasShadowedColor);
  shadowed *= mix(surface.groundTint, surface.skyTint, 0.5 + 0.5 * normal.y);
  if (material.unlit != 0) shadowed = lit;

  outShadow = vec4(light, lens, breakup, alpha);
  outLit = vec4(lit + emissive, alpha);
  outShadowed = vec4(shadowed + emissive, alpha);
}
