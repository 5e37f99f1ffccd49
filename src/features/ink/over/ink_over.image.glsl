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
layout(set = 1, binding = 0, scalar) uniform Block { InkOverUniforms u; };
layout(set = 1, binding = kInkOverPicture) uniform sampler2DArray soFar;
layout(set = 1, binding = kInkOverStrokes) uniform sampler2DArray strokes;
layout(set = 1, binding = kInkOverWarp) uniform sampler2DArray warp;
layout(set = 1, binding = kInkOverTiles) uniform sampler2DArray tiles;
layout(set = 1, binding = kInkOverLight) uniform sampler2DArray light;

// Coverage of the line around shadow shapes at a place: how much light differs within half its width.
float shadowLine(vec2 place, int layer) {
  float least = 1.0, most = 0.0;
  for (int i = 0; i < 9; ++i) {
    vec2 beside = i == 8 ? vec2(0.0) : u.shadowRadius * vec2(cos(0.7853982 * float(i)), sin(0.7853982 * float(i)));
    vec4 there = textureLod(light, vec3((place + beside) / frame.imageSize, layer), 0.0);
    if (there.a < 0.999) return 0.0;  // other edges have lines of their own
    least = min(least, there.r);
    most = max(most, there.r);
  }
  return u.shadowStrength * smoothstep(0.15, 0.85, most - least);
}

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
    ink = max(ink, shadowLine(place, layer) * vec4(1.0 - u.shadowColor, 1.0));
  if (ink.a > 0.0) {
    vec3 root = 1.0 - clamp(ink.rgb / ink.a, 0.0, 1.0);
    color = mix(color, vec4(root * root, 1.0), ink.a);
  }
  return color;
}

#include "../../../shading/image_pass.glsl"
