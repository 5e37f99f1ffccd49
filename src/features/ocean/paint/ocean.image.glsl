#version 460
// The ocean's colours in light and in shadow, as square roots, for every pixel where water is nearest or lies behind.
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/frame.glsl"
#include "../../../shading/luminance.shared.h"
#include "../../../shading/metatexture.glsl"
#include "../../../shading/way_to_viewer.glsl"
#include "../ocean.shared.h"
#include "ocean.shared.h"

layout(constant_id = 0) const int kNeeds = 0;
layout(constant_id = 1) const int kFeatures = 0;  // MetaTexture.features
const bool kFollows = (kNeeds & kOceanFollows) != 0;
const bool kNext = (kNeeds & kOceanNext) != 0;
layout(set = 1, binding = 0, scalar) uniform Block {
  MetaTexture metaOfLook;
  OceanPaint ocean;
};
layout(set = 1, binding = kOceanPatternBinding) uniform usampler2DArray pattern;
layout(set = 1, binding = kOceanWavesBinding) uniform usampler2DArray waves;
layout(set = 1, binding = kOceanDepthBinding) uniform sampler2DArray depth;
layout(set = 1, binding = kOceanExampleBinding) uniform sampler2D example;
layout(set = 1, binding = kOceanInverseBinding) uniform sampler2D inverse;
layout(set = 1, binding = kOceanFoamBinding) uniform sampler2D foamMap;
layout(set = 1, binding = kOceanBathicBinding) uniform sampler2D bathicMap;
layout(set = 1, binding = kOceanSkyBinding) uniform sampler2D skyMap;
layout(set = 1, binding = kOceanNextBathicBinding) uniform sampler2D nextBathicMap;
layout(set = 1, binding = kOceanNextSkyBinding) uniform sampler2D nextSkyMap;

vec3 graded(vec3 color, float saturation, vec3 overlay, float amount) {
  float gray = dot(color, kLuminance);
  return mix(max(mix(vec3(gray), color, saturation), 0.0), overlay, amount);
}

vec3 bathic(float depthIndex, float illumination) {
  vec2 at = vec2(depthIndex, illumination);
  vec3 color = textureLod(bathicMap, at, 0.0).rgb;
  if (kNext) color = mix(color, textureLod(nextBathicMap, at, 0.0).rgb, ocean.knobs.next);
  return graded(color, ocean.knobs.saturation, ocean.knobs.overlay, ocean.knobs.overlayAmount);
}

// Equations 27 to 30: the texture's three patterns in turn, and places of some metres each at a moment of their own.
float liveTexture(vec3 t, vec2 place, float nearness) {
  float own = sin(dot(place, vec2(0.21, 0.13))) + sin(dot(place, vec2(-0.11, 0.19)));
  float phase = ocean.phase + ocean.liveSpread * nearness * own;
  float wave = dot(t, vec3(0.707, 0.0, -0.707)) * cos(phase) + dot(t, vec3(-0.408, 0.816, -0.408)) * sin(phase);
  return clamp(0.5 + wave, 0.0, 1.0);
}

vec3 worldAt(ivec2 pixel, float far, int layer) {
  vec2 ndc = (vec2(pixel) + 0.5) / frame.imageSize * 2.0 - 1.0;
  vec4 toRay = VIEW_FIELD(ndcToEyeRay, layer);
  vec2 across = ndc * toRay.xy + toRay.zw;
  float parallel = VIEW_FIELD(orthographic, layer);
  vec3 inEye = vec3(across * mix(far, 1.0, parallel), -far);
  return VIEW_FIELD(eye, layer) + inEye * mat3(VIEW_FIELD(worldToEye, layer));
}

// The water's pattern, turned about the vertical so that strokes run across the direction that they are seen in (paper 000,
// section 3.5, whose exchange of axes has two directions and folds between them). It lies still in the world, in one of
// four directions; between two of them both are blended.
struct Turned {
  vec2 uv;
  MetaTextureChoice chosen;
};
const int kWays = 4;
Turned turnedWay(MetaTexture meta, float way, uvec4 packed) {
  float angle = way * (3.14159265 / float(kWays));
  vec2 across = vec2(cos(angle), sin(angle)), uv = uintBitsToFloat(packed.xy);
  vec2 dSdu = unpackBfloat(packed.z), dSdv = unpackBfloat(packed.w);
  Turned turned;
  turned.uv = vec2(dot(uv, across), across.x * uv.y - across.y * uv.x);
  turned.chosen = metaTextureChoose(meta, across.x * dSdu + across.y * dSdv, across.x * dSdv - across.y * dSdu, 1.0);
  return turned;
}

// The way that counts most where something is seen in that direction (world, x and z), the next one, and how much of the
// whole that is: 0 but between two of them.
vec3 waysAcross(vec2 direction) {
  float way = mod(atan(direction.x, -direction.y) * (float(kWays) / 3.14159265), float(kWays));
  float first = min(floor(way), float(kWays) - 1.0), second = mod(first + 1.0, float(kWays));
  float part = smoothstep(0.3, 0.7, way - first);
  return part < 0.5 ? vec3(first, second, part) : vec3(second, first, 1.0 - part);
}

// Two patterns of one mean, blended so that their deviation stays (FORMULAS 2).
vec4 blended(vec4 a, vec4 b, vec4 mean, float part) {
  return mean + (mix(a, b, part) - mean) * inversesqrt(part * part + (1.0 - part) * (1.0 - part));
}

// How much of the pattern tears the foam of wakes, ripples and splashes, where there is little of it and much.
const float kTornLittle = 0.15, kTornMuch = 0.55;

void paint(ivec3 here, float far, out vec3 lit, out vec3 shadowed) {
  ivec2 pixel = here.xy;
  int layer = here.z;
  MetaTexture meta = metaOfLook;
  meta.features = kFeatures;
  uvec4 packed = texelFetch(pattern, here, 0);
  uvec4 water = texelFetch(waves, here, 0);
  vec4 wave = vec4(unpackHalf2x16(water.x), unpackSnorm2x16(water.y));
  vec2 decorated = unpackUnorm2x16(water.z) * vec2(2.0, 1.0);
  vec2 uv = uintBitsToFloat(packed.xy);
  // Both eyes mirror the same sky, and see strokes that run the same way: what is hand-cut must not rival.
  vec3 world = worldAt(pixel, far, layer);
  vec3 eye = kViewCount > 1 ? 0.5 * (frame.views[0].eye + frame.views[1].eye) : frame.views[0].eye;
  vec3 toEye = eye - world;
  vec3 ways = kFollows ? waysAcross(-wayToViewer(world).xz) : vec3(0.0);
  Turned most = turnedWay(meta, ways.x, packed), least;
  vec4 value = metaTextureSample(meta, most.chosen, example, most.uv, vec2(0.0), vec2(pixel) + 0.5);
  bool isBetween = kFollows && ways.z > 0.0;
  for (bool mixes = isBetween; mixes; mixes = false) {
    least = turnedWay(meta, ways.y, packed);
    vec4 other = metaTextureSample(meta, least.chosen, example, least.uv, vec2(0.0), vec2(pixel) + 0.5);
    value = blended(value, other, meta.mean, ways.z);
  }
  if (metaTextureContrast(meta) == 2) value = metaTextureHistogram(inverse, value);

  float distance = max(length(toEye), 1e-6);
  toEye /= distance;
  float nearness = 1.0 - smoothstep(0.5 * ocean.fadeEnd, 3.0 * ocean.fadeEnd, distance);
  float stroke = liveTexture(value.rgb, uv * kWaterPerPattern, nearness);
  // Crests seen edge-on have neither strokes nor foam nor mirror anything: they would be dotted lines.
  vec3 normal = vec3(wave.z, sqrt(max(1.0 - dot(wave.zw, wave.zw), 0.0)), wave.w);
  float faces = smoothstep(0.1, 0.6, abs(dot(normal, toEye) / max(abs(toEye.y), 1e-3)));
  stroke = mix(0.5, stroke, mix(0.2, 1.0, nearness) * (1.0 - decorated.y) * faces);

  float index = 0.42 + 0.14 * clamp(wave.x, -2.0, 2.0) + ocean.knobs.dither * (stroke - 0.5);
  // From the middle of either half of the map on, by how the wave leans.
  float leans = dot(normal, frame.toLight) - frame.toLight.y;
  float shift = ocean.knobs.lightDither * (stroke - 0.5) + 2.0 * stroke * ocean.knobs.lightWaves * leans * faces * (1.0 - decorated.y);
  lit = bathic(index, 0.8 + shift), shadowed = bathic(index, 0.15 + shift);

  vec3 ray = reflect(-toEye, normal);
  float elevation = asin(clamp(abs(ray.y), 0.0, 1.0)) * 0.6366198;
  vec2 sun = frame.toLight.xz, away = ray.xz;
  float towards = dot(away, sun) * inversesqrt(max(dot(away, away) * dot(sun, sun), 1e-12));
  float azimuth = acos(clamp(towards, -1.0, 1.0)) * 0.31830989;
  vec2 inSky = vec2(azimuth, elevation) + ocean.knobs.skyDither * vec2(stroke - 0.5);
  vec4 sky = textureLod(skyMap, inSky, 0.0);
  if (kNext) sky = mix(sky, textureLod(nextSkyMap, inSky, 0.0), ocean.knobs.next);
  sky.rgb = graded(sky.rgb, ocean.knobs.skySaturation, ocean.knobs.skyOverlay, ocean.knobs.skyOverlayAmount);
  float reflected = ocean.knobs.reflection * sky.a;
  float shown = clamp((reflected - 0.5 + 0.9 * (stroke - 0.5)) * 14.0 + 0.5, 0.0, 1.0);
  shown *= min(10.0 * reflected, 1.0);  // not even the strongest stroke mirrors what is not there
  shown *= faces * (1.0 - min(decorated.x, 1.0));  // nor does what is churned
  lit = mix(lit, sky.rgb, shown);
  shadowed = mix(shadowed, mix(shadowed, sky.rgb, 0.5), shown);
  lit = sqrt(lit), shadowed = sqrt(shadowed);

  // Foam where crests are drawn together, most on faces that are turned against the wind.
  float drawn = clamp((ocean.knobs.foamStart - wave.y) * 2.5, 0.0, 1.0);
  float upwind = clamp(-4.0 * dot(wave.zw, ocean.wind), 0.0, 1.0);
  float cover = max(ocean.knobs.foam * 1.6 * drawn * (0.35 + 0.65 * upwind) * (1.0 - decorated.y) * faces, decorated.x);
  float foam = 0.0;
  for (bool isFoamy = cover > 1e-4; isFoamy; isFoamy = false) {
    float hole = metaTextureSample(meta, most.chosen, foamMap, most.uv, vec2(0.0), vec2(pixel) + 0.5).r;
    for (bool mixes = isBetween; mixes; mixes = false) {
      float other = metaTextureSample(meta, least.chosen, foamMap, least.uv, vec2(0.0), vec2(pixel) + 0.5).r;
      hole = mix(hole, other, ways.z);
    }
    // What decorations leave hangs together: torn at its edges, and gone where there is little, not left in pieces.
    hole = mix(hole, mix(0.5, hole, mix(kTornLittle, kTornMuch, smoothstep(0.4, 0.8, cover))), step(cover, decorated.x));
    foam = clamp((cover - hole) * 40.0, 0.0, 1.0);
  }
  lit = mix(lit, ocean.foamLit, foam);
  shadowed = mix(shadowed, ocean.foamShadowed, foam);
}

void shadeTwo(ivec2 pixel, int layer, out vec4 first, out vec4 second) {
  ivec3 here = ivec3(pixel, layer);
  float far = eyeDepth(texelFetch(depth, here, 0).r, layer);
  first = second = vec4(0.0);
  // A loop, since CPU drivers execute both sides of an `if` for all pixels.
  for (bool isWater = far < kNothing; isWater; isWater = false) {
    vec3 lit, shadowed;
    paint(here, far, lit, shadowed);
    first = vec4(lit, 1.0), second = vec4(shadowed, 1.0);
  }
}

#define SHADES_TWO
#include "../../../shading/image_pass.glsl"
