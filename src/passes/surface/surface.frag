#version 460
// The shadow channels and both colours of every surface in one geometry pass (FORMULAS 14): the colour pass then only
// mixes.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "../../shading/color_map.glsl"
#include "../../shading/light_space.glsl"
#include "../../shading/material.glsl"
#include "surface.glsl"

layout(constant_id = 0) const int kAlphaMode = 0;  // 0 opaque, 1 masked, 2 blended
layout(constant_id = 1) const int kVaried = 0;
layout(constant_id = 2) const int kTextured = 0;

layout(set = 2, binding = 0, scalar) uniform ParamsBlock { SurfaceParams params; };
layout(set = 2, binding = 1, scalar) uniform SurfaceBlock { SurfaceUniforms surface; };
layout(set = 2, binding = 2) uniform sampler2DArrayShadow shadowMap;

layout(location = 0) in vec3 inLightSpace;
layout(location = 1) in vec2 inFacing;
layout(location = 2) in vec4 inColor;
layout(location = 3) in vec4 inUvs;

layout(location = 0) out vec4 outShadow;
layout(location = 1) out vec4 outLit;
layout(location = 2) out vec4 outShadowed;

void main() {
  vec2 facing = gl_FrontFacing ? inFacing : -inFacing;
  float up = 0.5 + 0.5 * facing.y;

  // Square roots of the colours in light and in shadow, and what acts on the lens.
  vec3 lit = material.constantLit;
  vec3 shadowed = mix(material.constantShadowedDown, material.constantShadowedUp, up);
  float lens = material.constantLens;
  float alpha = material.baseColor.a;
  if (kVaried != 0) {
    vec4 albedo = material.baseColor * inColor;
    vec3 emissive = material.emissive;
    if (kTextured != 0) {
      albedo *= texture(baseTexture, inUvs.xy, params.simplify);
      emissive *= texture(emissiveTexture, inUvs.zw, params.simplify).rgb;
    }
    alpha = albedo.a;
    vec3 root = sqrt(clamp(albedo.rgb, 0.0, 1.0));
    lit = applyColorMap(material.lit, root);
    shadowed = mix(applyColorMap(material.shadowed, root), sqrt(material.shadowedColor), material.hasShadowedColor) *
               mix(material.tintDown, material.tintUp, up);
    shadowed = mix(shadowed, lit, material.unlit);
    lit = sqrt(lit * lit + emissive);
    shadowed = sqrt(shadowed * shadowed + emissive);
    lens = dot(emissive, vec3(0.2126, 0.7152, 0.0722));
  }
  if (kAlphaMode == 1 && alpha < material.alphaCutoff) discard;
  if (kAlphaMode != 2) alpha = 1.0;

  // Red: Lambert times cast shadow, steepened around the terminator. Outside the map there is nothing that could cast a
  // shadow, and its border is empty.
  float reaches = texture(shadowMap, vec4(shadowMapUv(inLightSpace.xy), 0.0, min(inLightSpace.z, 1.0)));
  float turn = facing.x - surface.terminator;
  float light = max(clamp(0.5 + turn * surface.terminatorSharpness, 0.0, 1.0) * reaches, material.unlit);

  // Blue: where the breakup map may act, which is where the surface is oblique to a light that reaches it.
  float oblique = clamp(1.0 - abs(turn) / params.indicationWidth, 0.0, 1.0) * reaches * params.indication;
  oblique *= 1.0 - material.unlit;

  outShadow = vec4(light, clamp(lens * params.lens, 0.0, 1.0), oblique, alpha);
  outLit = vec4(lit, alpha);
  outShadowed = vec4(shadowed, alpha);
}
