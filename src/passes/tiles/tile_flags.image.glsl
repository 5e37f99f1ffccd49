#version 460
// Flags of a tile, but for kTileMarked, from what lies in it and around it.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "../../shading/tiles.shared.h"
#include "tile_steps.shared.h"

// How far what lies around a tile counts, in tiles.
layout(constant_id = 0) const int kBlurReach = 0;  // 256 times as far as blurred light comes from, plus as far as what is
                                                   // blurred for that
layout(constant_id = 1) const int kTearReach = 0;  // as far as the warp moves colours, and surfaces are inflated
layout(constant_id = 2) const int kWanted = 0;     // kWantsTears ...
const int kShadedReach = kBlurReach / 256, kBlurredReach = kBlurReach % 256;
layout(set = 1, binding = 0, scalar) uniform Block { TileColors u; };
layout(set = 1, binding = kTileLeast) uniform sampler2DArray leastOfTiles;
layout(set = 1, binding = kTileMost) uniform sampler2DArray mostOfTiles;

uint found(float a) { return uint(a * 255.0 + 0.5); }

vec4 shade(ivec2 tile, int layer) {
  ivec2 last = textureSize(mostOfTiles, 0).xy - 1;
  const uint kEdge = kFoundNotLit | kFoundNotDark;
  uint near = 0u, far = 0u, beside = 0u, around = 0u;
  vec3 least = vec3(1.0), most = vec3(0.0);
  // The blur moves edges of light as far as it reaches, and tears move them on.
  const int kMovedReach = kShadedReach + kTearReach, reach = max(kBlurredReach, kMovedReach);
  const bool hasMarks = (uint(kWanted) & kWantsMarks) != 0u;
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      ivec3 at = ivec3(clamp(tile + ivec2(x, y), ivec2(0), last), layer);
      int away = max(abs(x), abs(y));
      vec4 there = texelFetch(mostOfTiles, at, 0);
      uint bits = found(there.a);
      near |= away <= kShadedReach ? bits : 0u;
      far |= away <= kBlurredReach ? bits : 0u;
      around |= away <= kMovedReach ? bits : 0u;
      if (away <= kTearReach) {
        beside |= bits;
        least = min(least, texelFetch(leastOfTiles, at, 0).rgb);
        most = max(most, there.rgb);
      }
    }
  uint own = found(texelFetch(mostOfTiles, ivec3(tile, layer), 0).a);
  vec3 range = most - least;
  bool isCovered = (own & kFoundCovered) != 0u, differs = max(range.r, max(range.g, range.b)) > u.least;
  bool isIndicated = hasMarks && (own & kFoundIndicated) != 0u;
  uint flags = 0u;
  if (isCovered) flags |= kTileCovered;
  bool isShaded = (near & kEdge) == kEdge || isIndicated;
  if (isCovered && isShaded) flags |= kTileShaded;
  if (!isShaded && (own & (kFoundOpen | kFoundFar)) == 0u) flags |= kTilePlain;
  if ((own & kFoundNotDark) != 0u) flags |= kTileLit;
  if ((far & kEdge) == kEdge || (hasMarks && (far & kFoundIndicated) != 0u)) flags |= kTileBlurred;
  bool isEdge = (uint(kWanted) & (kTearsAll | kTearsEverywhere)) != 0u || differs || (beside & (kFoundOpen | kFoundFar)) != 0u || (around & kEdge) == kEdge ||
                (beside & kFoundIndicated) != 0u;
  bool isNear = (uint(kWanted) & kTearsEverywhere) != 0u || (beside & kFoundCovered) != 0u;
  if ((uint(kWanted) & kWantsTears) != 0u && isNear && isEdge) flags |= kTileTorn;
  return vec4(float(flags) / 255.0, 0.0, 0.0, 0.0);
}

#define OUTPUT_FORMAT rgba8
#include "../../shading/image_pass.glsl"
