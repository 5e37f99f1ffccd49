#version 460
// The same of a tile: of as many such rows.
#extension GL_GOOGLE_include_directive : require
#define OUTPUT_FORMAT rgba8
#define SHADES_TWO
#include "../../shading/byte_bits.glsl"
#include "../../shading/tiles.shared.h"
#include "tile_steps.shared.h"

layout(set = 1, binding = kTileLeast) uniform sampler2DArray leastOfRows;
layout(set = 1, binding = kTileMost) uniform sampler2DArray mostOfRows;

void shadeTwo(ivec2 tile, int layer, out vec4 least, out vec4 most) {
  int last = textureSize(leastOfRows, 0).y - 1;
  least = vec4(1.0);
  most = vec4(0.0);
  uint bits = 0u;
  for (int i = 0; i < kTileSize; ++i) {
    ivec3 at = ivec3(tile.x, min(tile.y * kTileSize + i, last), layer);
    vec4 row = texelFetch(mostOfRows, at, 0);
    least = min(least, texelFetch(leastOfRows, at, 0));
    most = max(most, row);
    bits |= bitsOf(row.a);
  }
  most.a = channelOf(bits);
}

#include "../../shading/image_pass.glsl"
