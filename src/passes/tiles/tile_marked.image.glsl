#version 460
// kTileMarked besides: the pattern counts where it tears, as far as vectors reach, and where marks lie.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/byte_bits.glsl"
#include "../../shading/tiles.shared.h"
#include "tile_steps.shared.h"

layout(constant_id = 0) const int kTearReach = 0;  // as tile_flags has it
layout(constant_id = 1) const int kWanted = 0;     // kWantsTears ...
layout(set = 1, binding = kTileOwnFlags) uniform sampler2DArray ownFlags;

uint flagsAt(ivec2 tile, int layer) {
  ivec2 at = clamp(tile, ivec2(0), textureSize(ownFlags, 0).xy - 1);
  return bitsOf(texelFetch(ownFlags, ivec3(at, layer), 0).r);
}

vec4 shade(ivec2 tile, int layer) {
  uint flags = flagsAt(tile, layer), beside = 0u;
  for (int y = -kTearReach; y <= kTearReach; ++y)
    for (int x = -kTearReach; x <= kTearReach; ++x) beside |= flagsAt(tile + ivec2(x, y), layer);
  bool hasMarks = (kWanted & kWantsMarks) != 0 && (flags & kTileShaded) != 0u;
  if (hasMarks || (beside & kTileTorn) != 0u) flags |= kTileMarked;
  // Single samples are fetched from there, which have their light and all.
  if ((kWanted & kWantsMixed) != 0 && (flags & kTileMarked) != 0u) flags &= ~kTilePlain;
  return vec4(channelOf(flags), 0.0, 0.0, 0.0);
}

#define OUTPUT_FORMAT rgba8
#include "../../shading/image_pass.glsl"
