#version 460
// Strokes over the picture; torn as edges are: a pixel takes paint from where the warp takes its colour.
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/byte_bits.glsl"
#include "../../../shading/frame.glsl"
#include "../../../shading/tiles.shared.h"
#include "painting_over.shared.h"

layout(constant_id = 0) const bool kTears = false;
layout(set = 1, binding = 0, scalar) uniform Block { PaintingOverUniforms u; };
layout(set = 1, binding = kPaintingOverPicture) uniform sampler2DArray soFar;
layout(set = 1, binding = kPaintingOverPaint) uniform sampler2DArray paint;
layout(set = 1, binding = kPaintingOverWarp) uniform sampler2DArray warp;
layout(set = 1, binding = kPaintingOverTiles) uniform sampler2DArray tiles;

vec4 shade(ivec2 pixel, int layer) {
  vec4 color = texelFetch(soFar, ivec3(pixel, layer), 0);
  vec4 over;
  if (kTears && (bitsOf(texelFetch(tiles, ivec3(pixel / kTileSize, layer), 0).r) & kTileMarked) != 0u) {
    vec2 place = vec2(pixel) + 0.5 + u.warp * texelFetch(warp, ivec3(pixel, layer), 0).rg;
    over = textureLod(paint, vec3(place / frame.imageSize, layer), 0.0);
  } else {
    over = texelFetch(paint, ivec3(pixel, layer), 0);
  }
  if (over.a <= 0.0) return color;
  float rest = color.a * (1.0 - over.a), covered = over.a + rest;
  // The picture is multiplied by its coverage; square roots of colours are mixed as they are.
  vec3 behind = sqrt(max(color.rgb, vec3(0.0)) / max(color.a, 1e-6));
  vec3 root = (over.rgb + behind * rest) / max(covered, 1e-6);
  return vec4(root * root * covered, covered);
}

#include "../../../shading/image_pass.glsl"
