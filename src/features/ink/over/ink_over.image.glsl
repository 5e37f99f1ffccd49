#version 460
// Ink over the picture, with lines around shadow shapes, which are found here: where light is on one side of them and
// shadow on the other. Lines are broken as edges are: a pixel takes the ink from where the warp takes its colour.
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/byte_bits.glsl"
#include "../../../shading/frame.glsl"
#include "../../../shading/tiles.shared.h"
#include "ink_over.shared.h"

layout(constant_id = 0) const bool kTears = false;
layout(constant_id = 1) const bool kShadows = false;
layout(constant_id = 2) const bool kInMetres = false;  // widths of lines are
layout(set = 1, binding = 0, scalar) uniform Block { InkOverUniforms u; };
layout(set = 1, binding = kInkOverPicture) uniform sampler2DArray soFar;
layout(set = 1, binding = kInkOverStrokes) uniform sampler2DArray strokes;
layout(set = 1, binding = kInkOverWarp) uniform sampler2DArray warp;
layout(set = 1, binding = kInkOverTiles) uniform sampler2DArray tiles;
layout(set = 1, binding = kInkOverLight) uniform sampler2DArray light;
layout(set = 1, binding = kInkOverDepth) uniform sampler2DArray depth;

// Light after its threshold, without the inner glow, and coverage. Plain tiles, which nobody has written, are all in light
// or all in shadow; beside them nothing is read of theirs.
vec2 lightAt(vec2 place, int layer) {
  place = clamp(place, vec2(0.5), frame.imageSize - 0.5);
  ivec2 tile = ivec2(place) / kTileSize;
  uint flags = bitsOf(texelFetch(tiles, ivec3(tile, layer), 0).r);
  if ((flags & kTilePlain) != 0u) return vec2(float((flags & kTileLit) != 0u), 1.0);
  vec2 first = vec2(tile * kTileSize);
  vec2 within = clamp(place, first + 0.5, min(first + float(kTileSize), frame.imageSize) - 0.5);
  vec4 there = textureLod(light, vec3(within / frame.imageSize, layer), 0.0);
  return vec2(there.r - there.b, there.a);
}

// Coverage of the line around shadow shapes at a place: how much light differs within half its width.
float shadowLine(vec2 place, float radius, int layer) {
  float least = 1.0, most = 0.0, covered = 1.0;
  for (int i = 0; i < 9; ++i) {
    vec2 beside = i == 8 ? vec2(0.0) : radius * vec2(cos(0.7853982 * float(i)), sin(0.7853982 * float(i)));
    vec2 there = lightAt(place + beside, layer);
    covered = min(covered, there.y);
    least = min(least, there.x);
    most = max(most, there.x);
  }
  // Other edges have lines of their own.
  return covered < 0.999 ? 0.0 : smoothstep(0.15, 0.85, most - least);
}

// Edges of light are about a pixel and a half wide: lines that are thinner than that are lighter instead.
const float kThinnest = 0.75;

vec4 shade(ivec2 pixel, int layer) {
  vec4 color = texelFetch(soFar, ivec3(pixel, layer), 0);
  vec4 ink;
  uint flags = bitsOf(texelFetch(tiles, ivec3(pixel / kTileSize, layer), 0).r);
  bool isTorn = kTears && (flags & kTileMarked) != 0u;
  vec2 place = vec2(pixel) + 0.5;
  if (isTorn) {
    place += u.warp * texelFetch(warp, ivec3(pixel, layer), 0).rg;
    ink = textureLod(strokes, vec3(place / frame.imageSize, layer), 0.0);
  } else {
    ink = texelFetch(strokes, ivec3(pixel, layer), 0);
  }
  if (kShadows && (flags & kTileShaded) != 0u)
  {
    float metres = eyeDepth(texelFetch(depth, ivec3(pixel, layer), 0).r, layer);
    float radius = u.shadowRadius * (kInMetres ? 1.0 / mix(metres, 1.0, VIEW_FIELD(orthographic, layer)) : 1.0);
    float strength = min(radius / kThinnest, 1.0);
    ink = max(ink, strength * shadowLine(place, max(radius, kThinnest), layer) * vec4(1.0 - u.shadowColor, 1.0));
  }
  if (ink.a > 0.0) {
    vec3 root = 1.0 - clamp(ink.rgb / ink.a, 0.0, 1.0);
    color = mix(color, vec4(root * root, 1.0), ink.a);
  }
  return color;
}

#include "../../../shading/image_pass.glsl"
