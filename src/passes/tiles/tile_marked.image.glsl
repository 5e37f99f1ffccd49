#version 460
// kTileMarked besides: the pattern counts where it tears, as far as vectors reach, and where marks lie.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/tiles.shared.h"
#include "tile_steps.shared.h"

layout(constant_id = 0) const int kTearReach = 0;  // as tile_flags has it
layout(constant_id = 1) const int kWanted = 0;     // kWantsTears ...
layout(set = 1, binding = kTileOwnFlags) uniform sampler2DArray ownFlags;

uint flagsAt(ivec2 tile, int layer) {
  ivec2 at = clamp(tile, ivec2(0), textureSize(ownFlags, 0).xy - 1);
  return uint(texelFetch(ownFlags, ivec3(at, layer), 0).r * 255.0 + 0.5);
}

vec4 shade(ivec2 tile, int layer) {
  uint flags = flagsAt(tile, layer), beside = 0u;
  for (int y = -kTearReach; y <= kTearReach; ++y)
    for (int x = -kTearReach; x <= kTearReach; ++x) beside |= flagsAt(tile + ivec2(x, y), layer);
  bool hasMarks = (uint(kWanted) & kWantsMarks) != 0u && (flags & kTileShaded) != 0u;
  if (hasMarks || (beside & kTileTorn) != 0u) flags |= kTileMarked;
  return vec4(float(flags) / 255.0, 0.0, 0.0, 0.0);
}

#define OUTPUT_FORMAT rgba8
#include "../../shading/image_pass.glsl"
