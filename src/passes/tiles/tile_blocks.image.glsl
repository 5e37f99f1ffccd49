#version 460
// Blocks of tiles besides, so that what runs on all of one is drawn at once.
// Out: R: a tile's flags; G, B: those that all tiles of its block have, and those that any has.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/byte_bits.glsl"
#include "../../shading/tiles.shared.h"
#include "tile_steps.shared.h"

layout(set = 1, binding = kTileOwnFlags) uniform sampler2DArray ownFlags;

vec4 shade(ivec2 tile, int layer) {
  ivec2 last = textureSize(ownFlags, 0).xy - 1, first = tile / kTileBlock * kTileBlock;
  uint every = 255u, any = 0u;
  for (int i = 0; i < kTileBlock * kTileBlock; ++i) {
    ivec2 at = min(first + ivec2(uint(i) % uint(kTileBlock), i / kTileBlock), last);
    uint flags = bitsOf(texelFetch(ownFlags, ivec3(at, layer), 0).r);
    every &= flags;
    any |= flags;
  }
  return vec4(texelFetch(ownFlags, ivec3(tile, layer), 0).r, channelOf(every), channelOf(any), 0.0);
}

#define OUTPUT_FORMAT rgba8
#include "../../shading/image_pass.glsl"
