#version 460
// The shadow channels and both colours of every surface in one geometry pass (FORMULAS 14): the colour pass then only
// mixes.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/cutouts.glsl"
#include "../../shading/frame.glsl"
#include "../../shading/color_map.glsl"
#include "../../shading/light_space.glsl"
#include "../../shading/luminance.shared.h"
#define TRANSPARENT_TEXTURES
#include "../../shading/material.glsl"
#define METATEXTURE_UNROLLS
#include "../../shading/metatexture.glsl"
#include "../../shading/punctual_lights.glsl"
#include "../../shading/surface_tangents_at_pixel.glsl"
#include "../../shading/view_index.glsl"
#include "surface.glsl"

layout(constant_id = kAlphaModeId) const int kAlphaMode = 0;  // 0 opaque, 1 masked, 2 blended
layout(constant_id = kVariedId) const int kVaried = 0;
layout(constant_id = kTexturedId) const int kTextured = 0;
// 1: only what lies behind the first surface; 2: there are lights; 4: highlights; 8: there may be veils.
layout(constant_id = kPassId) const int kOptions = 0;
layout(constant_id = kColorSetsId) const int kSets = 0;     // sets of colours of its own: 1 for light, 2 for shadow
// Of what the look paints.
layout(constant_id = kFeaturesId) const int kFeatures = 0;
layout(constant_id = kTangentsId) const int kTangents = 0;
layout(constant_id = kMaterialId) const int kBlend = 0;  // how it is laid: 0 multiply, 1 overlay, 2 replace
const bool kBehind = (kOptions & 1) != 0;

#ifdef TRANSPARENT
layout(set = 2, binding = kSurfaceKnobs, scalar) readonly buffer ParamRows { SurfaceParams paramRows[]; };
#define params paramRows[materialIndex]
layout(location = 11) flat in uint inPart;
#else
layout(set = 2, binding = kSurfaceKnobs, scalar) uniform ParamsBlock { SurfaceParams params; };
#endif
layout(set = 2, binding = kSurfaceLight, scalar) uniform LightKnobs { LightParams keyLight; };
layout(set = 2, binding = kSurfaceShadowMap) uniform sampler2DArrayShadow shadowMap;
#ifdef TRANSPARENT
layout(set = 2, binding = kBlendedVeils) uniform sampler2DArray veils;
#else
layout(set = 2, binding = kSurfaceVeils) uniform sampler2DArray veils;
layout(set = 2, binding = kSurfaceFirstDepth) uniform sampler2DArray firstDepth;
layout(location = 12) flat in uint inHidesBacks;
#endif

layout(location = 0) in vec3 inLightSpace;
layout(location = 1) in vec3 inFacing;
layout(location = 2) in vec4 inColor;
layout(location = 3) in vec4 inUvs;
layout(location = 9) in vec3 inWorld;
layout(location = 10) in vec3 inNormal;
layout(location = 13) in vec4 inIndirect;

#ifdef APART
layout(location = 0) out vec4 outColor;
layout(location = 1) out vec4 outDistance;
#else
layout(location = 0) out vec4 outShadow;
layout(location = 1) out vec4 outLit;
layout(location = 2) out vec4 outShadowed;
#endif

#ifdef PAINTED
#ifdef TRANSPARENT
layout(set = 2, binding = kSurfacePainted, scalar) readonly buffer PaintedRows { PaintedMaterial paintedRows[]; };
#define painted paintedRows[materialIndex]
#else
layout(set = 2, binding = kSurfacePainted, scalar) uniform PaintedBlock { PaintedMaterial painted; };
#endif
layout(set = 2, binding = kSurfaceExample) uniform sampler2D paintedExample;
layout(set = 2, binding = kSurfaceInverse) uniform sampler2D paintedInverse;
layout(location = 4) in vec2 inPatternUv;
layout(location = 5) in vec3 inTangentU;
layout(location = 6) in vec3 inTangentV;
layout(location = 7) in vec3 inPoint;
layout(location = 8) flat in uint inWraps;

// What the look paints.
vec3 paintedTexture() {
  vec2 dSdu, dSdv;
  surfaceTangents(kTangents, inTangentU, inTangentV, inPoint, inPatternUv, viewIndex(), dSdu, dSdv);
  MetaTexture meta = painted.meta;
  meta.features = kFeatures;
  MetaTextureChoice chosen = metaTextureChoose(meta, dSdu, dSdv, 1.0);
  vec4 value = metaTextureSample(meta, chosen, paintedExample, inPatternUv,
                                 vec2(inWraps & 1u, inWraps >> 1), gl_FragCoord.xy);
  if (metaTextureContrast(meta) == 2) value = metaTextureHistogram(paintedInverse, value);
  return clamp(value.rgb, 0.0, 1.0);
}

// It over the square root of a colour.
vec3 paint(vec3 over, vec3 root) {
  vec3 result = over;
  if (kBlend == 0) result = root * over;
  if (kBlend == 1)
    result = mix(2.0 * root * over, 1.0 - 2.0 * (1.0 - root) * (1.0 - over), greaterThan(root, vec3(0.5)));
  return mix(root, result, painted.amount);
}
#endif

// Key light that blended surfaces hold back, 0 to 1: the mean of the four texels around, of those that lie nearer to the
// light.
float veilAt(vec3 lightSpace) {
  const float kBias = 2.0 / 1024.0;  // what halves round, twice
  vec2 texels = vec2(textureSize(veils, 0).xy), place = shadowMapUv(lightSpace.xy) * texels - 0.5, f = fract(place);
  vec3 middle = vec3((floor(place) + 1.0) / texels, 0.0);
  vec4 holds = textureGather(veils, middle, 1) * vec4(greaterThan(textureGather(veils, middle, 0), vec4(1.0 - lightSpace.z + kBias)));
  vec2 rows = mix(holds.wx, holds.zy, f.x);
  return mix(rows.x, rows.y, f.y);
}

#ifdef PREPAINTED
layout(set = 2, binding = kSurfacePrepaintedLit) uniform sampler2DArray prepaintedLit;
layout(set = 2, binding = kSurfacePrepaintedShadowed) uniform sampler2DArray prepaintedShadowed;
#endif

// How round a form is, for marks: by how much its Lambert term changes over a picture's height. Planes and what is nearly
// one have no terminator; a form that is smaller than a twentieth of the picture has no room for marks.
float roundness(vec2 slope) {
  float change = length(slope) * frame.knobHeight;
  return smoothstep(0.05, 0.4, change) * (1.0 - smoothstep(25.0, 60.0, change));
}

// Where a smooth surface mirrors the key light to the middle of all eyes: 0 or 1, but for the edge.
float highlight(vec3 normal) {
  float least = inversesqrt(1.0 + params.highlightSize * params.highlightSize);
  float inside = dot(normal, normalize(frame.toLight + normalize(frame.viewer - inWorld))) - least;
  return clamp(0.5 + inside / max(fwidth(inside), 1e-6), 0.0, 1.0) * params.highlight * (1.0 - material.unlit);
}

// How near other surfaces are, in steps; and shadow there: in their hue, as light as it is, and deeper.
const float kOpen = 0.06, kClosed = 0.5;  // shares of the half sphere between which steps are
const float kDeepest = 0.4;
float nearness() {
  float steps = float(kOptions >> kSurfaceStepsBit), at = steps * clamp((inIndirect.a - kOpen) / (kClosed - kOpen), 0.0, 1.0);
  float edge = clamp(0.7 * fwidth(at), 1e-4, 0.5), before = floor(at);
  return (before + smoothstep(0.5 - edge, 0.5 + edge, at - before)) / steps;
}
vec3 besideOthers(vec3 shadowed, float near) {
  float value = dot(shadowed * shadowed, kLuminance), theirs = dot(inIndirect.rgb * inIndirect.rgb, kLuminance);
  vec3 hue = min(inIndirect.rgb * sqrt(value / max(theirs, 0.02)), vec3(1.0));
  vec3 tinted = mix(shadowed, hue, 0.6 * near * params.bounce * (1.0 - material.unlit));
  return tinted * (1.0 - kDeepest * near * params.occlusion * (1.0 - material.unlit));
}

void main() {
  vec2 slope = vec2(dFdx(inFacing.z), dFdy(inFacing.z));  // neighbours are needed, so before any is discarded
  const bool hasIndirect = (kOptions & (kSurfaceIndirect | kSurfaceIndirectColors)) != 0;
  float mirrored = 0.0, near = hasIndirect ? nearness() : 0.0;
#ifdef TRANSPARENT
  materialIndex = materialOf(inPart);
  bool isFront = seesFront(inPart, gl_FrontFacing);
  if ((kOptions & 4) != 0) mirrored = highlight(normalize(isFront ? inNormal : -inNormal));
  bool isVaried = kVaried != 0 && (isVariedPart(inPart) || materialRows[materialIndex].varies != 0);
  ivec4 slots = materialRows[materialIndex].slots;
  bool hasShadowedSet = slots.w >= 0;
  SlotValues here = sampleSlots(ivec4(slots.x, -1, slots.zw), inUvs.xy, params.simplify);
  SlotValues emissiveHere = sampleSlots(ivec4(-1, slots.y, -1, -1), inUvs.zw, params.simplify);
  if (isCulled(isFront)) discard;
#else
  bool isFront = gl_FrontFacing;
  if ((kOptions & 4) != 0) mirrored = highlight(normalize(isFront ? inNormal : -inNormal));
  const bool isVaried = kVaried != 0, hasShadowedSet = (kSets & 2) != 0;
  if (kBehind) {
    // Where a form is torn away, what is inside of it goes with it.
    if (!isFront && inHidesBacks != 0u) discard;
    float first = texelFetch(firstDepth, ivec3(gl_FragCoord.xy, viewIndex()), 0).r;
    if (eyeDepth(gl_FragCoord.z, viewIndex()) < 1.005 * eyeDepth(first, viewIndex())) discard;
  }
#endif
  vec3 facing = isFront ? inFacing : -inFacing;
  float up = 0.5 + 0.5 * facing.y;
  // Planes of one colour in the light: those that face it, such as turn away, and those that face the sky.
  vec3 plane = mix(material.planeTurned, vec3(1.0), smoothstep(0.15, 0.6, facing.x));
  plane = mix(plane, material.planeSky, smoothstep(0.6, 0.95, facing.y));

  // Square roots of the colours in light and in shadow, and what acts on the lens.
  vec3 lit = min(material.constantLit * plane, vec3(1.0));
  vec3 shadowed = mix(material.constantShadowedDown, material.constantShadowedUp, up);
  float lens = material.constantLens;
  float alpha = material.baseColor.a;
#ifdef PREPAINTED
  // Painted already, once a pixel whose middle it is; at its edges that may be a pixel beside this one.
  ivec3 here = ivec3(gl_FragCoord.xy, viewIndex());
  vec4 painting = texelFetch(prepaintedLit, here, 0);
  for (bool isEdge = painting.a == 0.0; isEdge; isEdge = false) {
    const ivec2 kBeside[] = ivec2[](ivec2(0, 1), ivec2(1, 0), ivec2(-1, 0), ivec2(0, -1), ivec2(1, 1), ivec2(-1, 1),
                                    ivec2(1, -1), ivec2(-1, -1));
    for (int i = 0; i < 8 && painting.a == 0.0; ++i) {
      ivec3 beside = ivec3(clamp(here.xy + kBeside[i], ivec2(0), ivec2(frame.imageSize) - 1), here.z);
      painting = texelFetch(prepaintedLit, beside, 0);
      if (painting.a != 0.0) here = beside;
    }
  }
  lit = painting.rgb;
  shadowed = texelFetch(prepaintedShadowed, here, 0).rgb;
#else
#if defined(PAINTED) && defined(TRANSPARENT)
  vec3 over = paintedTexture();  // mip levels need neighbours
#endif
  if (isVaried) {
    vec4 albedo = material.baseColor * inColor;
    vec3 emissive = material.emissive;
    vec3 own = sqrt(material.shadowedColor);
#ifdef TRANSPARENT
    albedo *= here.values[0];
    emissive *= emissiveHere.values[1].rgb;
    if (slots.z >= 0) albedo.rgb = here.values[2].rgb;
    if (hasShadowedSet) own = sqrt(here.values[3].rgb);
    alpha = albedo.a;
#else
    if (kTextured != 0) {
      albedo *= texture(baseTexture, inUvs.xy, params.simplify);
      emissive *= texture(emissiveTexture, inUvs.zw, params.simplify).rgb;
    }
    alpha = albedo.a;
    if ((kSets & 1) != 0) albedo.rgb = texture(litTexture, inUvs.xy, params.simplify).rgb;
    if (hasShadowedSet) own = sqrt(texture(shadowedTexture, inUvs.xy, params.simplify).rgb);
#endif
    vec3 root = sqrt(clamp(albedo.rgb, 0.0, 1.0));
#ifdef PAINTED
#ifndef TRANSPARENT
    vec3 over = paintedTexture();
#endif
    root = paint(over, root);
    if (hasShadowedSet) own = paint(over, own);
#endif
    lit = applyColorMap(material.lit, root);
    shadowed = applyColorMap(material.shadowed, root);
    vec3 tint = mix(material.tintDown, material.tintUp, up);
    if (hasShadowedSet)
      shadowed = mix(shadowed * tint, applyColorMap(material.ownShadowed, own), material.hasShadowedColor);
    else
      shadowed = mix(shadowed, own, material.hasShadowedColor) * tint;
    lit = mix(lit, shadowed, blackness(dot(root * root, kLuminance), material.blacks));
    shadowed = mix(shadowed, lit, material.unlit);
    lit = min(lit * plane, vec3(1.0));
    lit = sqrt(lit * lit + emissive);
    shadowed = sqrt(shadowed * shadowed + emissive);
    lens = dot(emissive, kLuminance);
  }
#endif
  if (kAlphaMode == kCut && isCutOut(viewIndex())) discard;
  if (kAlphaMode == 1 && alpha < material.alphaCutoff) discard;
  if (kAlphaMode != 2) alpha = 1.0;

  if (hasIndirect) shadowed = besideOthers(shadowed, near);

  // Red: Lambert times cast shadow, steepened around the terminator. Outside the map there is nothing that could cast a
  // shadow, and its border is empty.
  float reaches = texture(shadowMap, vec4(shadowMapUv(inLightSpace.xy), 0.0, min(inLightSpace.z, 1.0)));
  float turn = mix(facing.x, facing.z, keyLight.roundness) - keyLight.terminator;
  float light = clamp(0.5 + turn * keyLight.terminatorSharpness, 0.0, 1.0) * reaches;
  if ((kOptions & 2) != 0)
    light = min(light + punctualLight(inWorld, normalize(isFront ? inNormal : -inNormal)), 1.0);
  light = max(light, material.unlit);

  // What a matte shows has its own light already; only what is cast on it is new.
  light = mix(light, frame.toLight.y > 0.0 ? reaches : 1.0, material.matte);

  // Blue: where the breakup map may act, which is beside the terminator of round forms. On the dark side it ends where the
  // surface turns away from the light altogether, since it lies in its own shadow there.
  float darkWidth = min(params.indicationWidth, max(keyLight.terminator, 1e-3));
  float formTurn = facing.z - keyLight.terminator;
  float away = formTurn / mix(params.indicationWidth, -darkWidth, float(formTurn < 0.0));
  float oblique = clamp(1.0 - away, 0.0, 1.0) * reaches * params.indication * roundness(slope);
  oblique *= 1.0 - material.unlit;
#ifdef PREPAINTED
  oblique = 0.0;  // it has strokes of its own
#endif

  // The shadow of what lets light through is a paler colour and no shape of light, which is whole or not there.
  if ((kOptions & 8) != 0) {
    float held = veilAt(inLightSpace) * (1.0 - material.unlit);
    lit = sqrt(mix(lit * lit, shadowed * shadowed, held));
  }

  lens = clamp(lens * params.lens + mirrored * reaches + params.glow, 0.0, 1.0);
  float whole = clamp(0.5 + 8.0 * (light - 0.5), 0.0, 1.0);  // where nothing blurs and thresholds it later
#ifdef TRANSPARENT
  // Light is one number a pixel. A surface that lets through what is behind it leaves that number to that, and its colours
  // have its own light and shadow side; the more opaque it is, the more the number is its own.
  float opaque = smoothstep(0.5, 1.0, alpha);
  vec3 own = sqrt(mix(shadowed * shadowed, lit * lit, whole));
#ifdef APART
  outColor = vec4(own, 1.0) * alpha;
  outDistance = vec4(eyeDepth(gl_FragCoord.z, viewIndex()) / frame.sceneRadius, 1.0, 0.0, 1.0) * alpha;
#else
  outShadow = vec4(vec3(light, 0.0, oblique) * opaque, opaque);
  outShadow.g = lens * alpha;
  outLit = vec4(mix(own, lit, opaque), 1.0) * alpha;
  outShadowed = vec4(mix(own, shadowed, opaque), 1.0) * alpha;
#endif
#else
  outShadow = vec4(kBehind ? whole : light, lens, oblique, alpha);
  outLit = vec4(lit, alpha) * (1.0 - material.matte);
  outShadowed = vec4(shadowed, alpha) * (1.0 - material.matte);
#endif
}
