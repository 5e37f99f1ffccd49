#version 460
// Ink over the picture. Lines are broken as edges are: a pixel takes the ink from where the warp takes its colour.
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/byte_bits.glsl"
#include "../../../shading/frame.glsl"
#include "../../../shading/tiles.shared.h"
#include "ink_over.shared.h"

layout(constant_id = 0) const bool kTears = false;
layout(set = 1, binding = 0, scalar) uniform Block { InkOverUniforms u; };
layout(set = 1, binding = kInkOverPicture) uniform sampler2DArray soFar;
layout(set = 1, binding = kInkOverStrokes) uniform sampler2DArray strokes;
layout(set = 1, binding = kInkOverWarp) uniform sampler2DArray warp;
layout(set = 1, binding = kInkOverTiles) uniform sampler2DArray tiles;

vec4 shade(ivec2 pixel, int layer) {
  vec4 color = texelFetch(soFar, ivec3(pixel, layer), 0);
  vec4 ink;
  bool isTorn = kTears && (bitsOf(texelFetch(tiles, ivec3(pixel / kTileSize, layer), 0).r) & kTileMarked) != 0u;
  if (isTorn) {
    vec2 vector = u.warp * texelFetch(warp, ivec3(pixel, layer), 0).rg;
    ink = textureLod(strokes, vec3((vec2(pixel) + 0.5 + vector) / frame.imageSize, layer), 0.0);
  } else {
    ink = texelFetch(strokes, ivec3(pixel, layer), 0);
  }
  if (ink.a > 0.0) {
    vec3 root = 1.0 - clamp(ink.rgb / ink.a, 0.0, 1.0);
    color = mix(color, vec4(root * root, 1.0), ink.a);
  }
  return color;
}

#include "../../../shading/image_pass.glsl"
