#version 460
// Ink over the picture. Lines are broken as edges are: a pixel takes the ink from where the warp takes its colour.
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/byte_bits.glsl"
#include "../../../shading/frame.glsl"
#include "../../../shading/tiles.shared.h"
#include "ink_over.shared.h"

layout(constant_id = 0) const int kOptions = 0;        // kInkOverTears ...
layout(constant_id = 1) const bool kInMetres = false;  // widths of lines are
layout(constant_id = 2) const int kLines = 0;           // bits of kinds, and kReach
layout(set = 1, binding = 0, scalar) uniform Block { InkOverUniforms u; };
layout(set = 1, binding = kInkOverPicture) uniform sampler2DArray soFar;
layout(set = 1, binding = kInkOverStrokes) uniform sampler2DArray strokes;
layout(set = 1, binding = kInkOverWarp) uniform sampler2DArray warp;
layout(set = 1, binding = kInkOverTiles) uniform sampler2DArray tiles;
layout(set = 1, binding = kInkOverLight) uniform sampler2DArray light;
layout(set = 1, binding = kInkOverDepth) uniform sampler2DArray depth;
layout(set = 1, binding = kInkOverPieces) uniform sampler2DArray pieces;
layout(set = 1, binding = kInkOverExtent) uniform sampler2DArray extent;
#include "ink_found.glsl"

vec4 shade(ivec2 pixel, int layer) {
  vec4 color = texelFetch(soFar, ivec3(pixel, layer), 0);
  vec4 ink;
  uint flags = bitsOf(texelFetch(tiles, ivec3(pixel / kTileSize, layer), 0).r);
  bool isTorn = (kOptions & kInkOverTears) != 0 && (flags & kTileMarked) != 0u;
  vec2 place = vec2(pixel) + 0.5;
  if (isTorn) {
    place += u.warp * texelFetch(warp, ivec3(pixel, layer), 0).rg;
    ink = textureLod(strokes, vec3(place / frame.imageSize, layer), 0.0);
  } else {
    ink = texelFetch(strokes, ivec3(pixel, layer), 0);
  }
  bool isOverlay = (kOptions & kInkOverIsOverlay) != 0;
  float metres = 0.0;
  if (!isOverlay) ink = withFoundLines(ink, pixel, place, layer, metres);
  if ((kOptions & kInkOverEnds) != 0) ink *= texelFetch(extent, ivec3(pixel, layer), 0).r;
  if (ink.a > 0.0) {
    vec3 root = clamp(ink.rgb / ink.a, 0.0, 1.0);
    if (!isOverlay) root = 1.0 - root;
    color = mix(color, vec4(root * root, 1.0), ink.a);
  }
  return color;
}

#include "../../../shading/image_pass.glsl"
