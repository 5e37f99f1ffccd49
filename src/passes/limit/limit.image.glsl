#version 460
// The picture in the colours of a palette. Of a pixel's colour the nearest one of the palette is found, and of the
// others the one towards which it lies farthest on the way; the breakup map decides between these two, so that a gradient
// becomes a broken band of palette-knife marks.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "../../shading/oklab.glsl"
#include "limit.shared.h"

layout(constant_id = 0) const int kColors = 16;  // 0: none, colours stay; else the palette's, rounded up to a multiple of 4
layout(constant_id = 1) const int kMarks = 2;    // 0: none; 1: on surfaces; 2: in the sky as well
layout(set = 1, binding = 0, scalar) uniform Block { LimitUniforms u; };
layout(set = 1, binding = kLimitColor) uniform sampler2DArray color;
layout(set = 1, binding = kLimitWarp) uniform sampler2DArray warp;
layout(set = 1, binding = kLimitDepth) uniform sampler2DArray depth;
layout(set = 1, binding = kLimitStrokes) uniform sampler2D strokes;

#define PALETTE u.colors
#include "../../shading/nearest_color.glsl"

// Half of the most that an edge may be wide, of the way from one colour to another.
const float kWidest = 0.1;
// Distances in OKLab's plane of hue and chroma: marks of two colours farther apart would be noise.
const float kNearHues = 0.13, kFarHues = 0.20;

// Whether a colour drifts, by the parts of the way from one of the palette's to the other that it goes within a few
// pixels and within half as many: what is flat stays flat, and an edge, all of which lies in one half, is not broken.
vec2 drifts(vec2 byHalf, vec2 byWhole) {
  vec2 part = 2.0 * min(abs(byHalf), abs(byWhole - byHalf));
  return smoothstep(0.005, 0.03, part) * (1.0 - smoothstep(0.3, 0.6, part));
}

vec3 conesAt(ivec2 pixel, int layer) {
  vec4 straight = texelFetch(color, ivec3(pixel, layer), 0);
  return conesFromLinear(straight.rgb * (1.0 / max(straight.a, 1e-3)));
}

// Strokes that lie along the horizon, by the direction that the pixel looks in.
float skyMarks(ivec2 pixel, int layer) {
  vec2 ndc = (vec2(pixel) + 0.5) / frame.imageSize * 2.0 - 1.0;
  vec4 toRay = VIEW_FIELD(ndcToEyeRay, layer);
  vec3 ray = vec3((ndc * toRay.xy + toRay.zw) * (1.0 - VIEW_FIELD(orthographic, layer)), -1.0);
  vec3 world = vec3(dot(VIEW_FIELD(worldToEye[0].xyz, layer), ray), dot(VIEW_FIELD(worldToEye[1].xyz, layer), ray),
                    dot(VIEW_FIELD(worldToEye[2].xyz, layer), ray));
  vec2 angles = vec2(atan(world.x, -world.z), atan(world.y, length(world.xz)));
  return textureLod(strokes, angles * u.skyTiles + u.skyShift, u.skyLod).r;
}

// From dark to light, and where two are alike in any one order.
float order(vec3 lab) { return lab.x + 0.01 * lab.y + 0.001 * lab.z; }

vec4 shade(ivec2 pixel, int layer) {
  vec4 own = texelFetch(color, ivec3(pixel, layer), 0);
  if (kColors == 0) return own;
  vec3 weights = vec3(u.knobs.lightness, 1.0, 1.0), cones = conesAt(pixel, layer), roots = cubeRoot(cones);
  vec3 lab = weights * oklabFromConeRoots(roots);

  vec3 nearest = nearestColor(lab);
  // Its neighbour: the one towards which the pixel lies farthest on the way.
  vec3 beside = nearest, from = lab - nearest;
  float farthest = 0.0;
  for (int i = 0; i < kColors; ++i) {
    vec3 there = u.colors[i] - nearest;
    float part = dot(from, there) / max(dot(there, there), 1e-8);
    beside = part > farthest ? u.colors[i] : beside;
    farthest = max(part, farthest);
  }

  // Where it lies between the two, beyond which the lighter one is taken.
  bool isDarker = order(beside) < order(nearest);
  vec3 dark = isDarker ? beside : nearest, light = isDarker ? nearest : beside;
  vec3 way = light - dark, along = way / max(dot(way, way), 1e-8);
  float beyond = dot(lab - dark, along) - 0.5;

  // FORMULAS 15: the edge between them is about `softness` pixels wide, whatever the slope of colours and marks.
  ivec2 last = ivec2(frame.imageSize) - 1, right = min(pixel + ivec2(1, 0), last), below = min(pixel + ivec2(0, 1), last);
  vec3 byCones = slopeByCones(along * weights, roots);
  vec2 slope = vec2(dot(conesAt(right, layer) - cones, byCones), dot(conesAt(below, layer) - cones, byCones));
  float skySlope = 0.0;
  if (kMarks > 0) {
    vec4 warped = texelFetch(warp, ivec3(pixel, layer), 0);
    // The warp reaches beyond silhouettes; what is there is sky.
    bool onSurface = warped.a > 0.0 && texelFetch(depth, ivec3(pixel, layer), 0).r > 0.0;
    float near = 1.0 - smoothstep(kNearHues, kFarHues, length(way.yz));
    ivec2 whole = ivec2(u.driftReach, 0), middle = whole / 2;
    vec2 byHalf = vec2(dot(conesAt(min(pixel + middle, last), layer) - cones, byCones),
                       dot(conesAt(min(pixel + middle.yx, last), layer) - cones, byCones));
    vec2 byWhole = vec2(dot(conesAt(min(pixel + whole, last), layer) - cones, byCones),
                        dot(conesAt(min(pixel + whole.yx, last), layer) - cones, byCones));
    vec2 drift = drifts(byHalf, byWhole);
    float dither = onSurface ? near * max(drift.x, drift.y) * u.dither : 0.0;
    beyond += dither * (warped.b - 0.5);
    slope += dither * (vec2(texelFetch(warp, ivec3(right, layer), 0).b, texelFetch(warp, ivec3(below, layer), 0).b) -
                       warped.b);
    if (kMarks == 2) {
      float sky = onSurface ? 0.0 : near;
      beyond += sky * u.skyDither * (skyMarks(pixel, layer) - 0.5);
      skySlope = sky * u.skySlope;
    }
  }
  float width = clamp(0.5 * u.knobs.softness * (length(slope) + skySlope), 1e-5, kWidest);
  vec3 snapped = mix(dark, light, clamp(0.5 + 0.5 * beyond / width, 0.0, 1.0));

  vec3 result = mix(lab, snapped, u.knobs.amount) * vec3(1.0 / u.knobs.lightness, 1.0, 1.0);
  return vec4(max(linearFromOklab(result), vec3(0.0)) * own.a, own.a);
}

#include "../../shading/image_pass.glsl"
