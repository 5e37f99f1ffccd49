#version 460
// Flags of a tile, but for kTileMarked, from what lies in it and around it.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/byte_bits.glsl"
#include "../../shading/tiles.shared.h"
#include "tile_steps.shared.h"

// How far what lies around a tile counts, in tiles.
layout(constant_id = 0) const int kBlurReach = 0;  // 256 times as far as blurred light comes from, plus as far as what is
                                                   // blurred for that
layout(constant_id = 1) const int kTearReach = 0;  // as far as the warp moves colours, and surfaces are inflated
layout(constant_id = 2) const int kWanted = 0;     // kWantsTears ...
const int kShadedReach = kBlurReach / 256, kBlurredReach = kBlurReach - 256 * kShadedReach;
layout(set = 1, binding = kTileLeast) uniform sampler2DArray leastOfTiles;
layout(set = 1, binding = kTileMost) uniform sampler2DArray mostOfTiles;

vec4 shade(ivec2 tile, int layer) {
  ivec2 last = textureSize(mostOfTiles, 0).xy - 1;
  const uint kEdge = kFoundNotLit | kFoundNotDark;
  uint near = 0u, far = 0u, beside = 0u, around = 0u;
  vec3 least = vec3(1.0), most = vec3(0.0);
  // The blur moves edges of light as far as it reaches, and tears move them on.
  const int kMovedReach = kShadedReach + kTearReach, reach = max(kBlurredReach, kMovedReach);
  const bool hasMarks = (kWanted & kWantsMarks) != 0, hasTears = (kWanted & kWantsTears) != 0;
  const bool tearsAll = (kWanted & kTearsAll) != 0, tearsEverywhere = (kWanted & kTearsEverywhere) != 0;
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      ivec3 at = ivec3(clamp(tile + ivec2(x, y), ivec2(0), last), layer);
      int away = max(abs(x), abs(y));
      vec4 there = texelFetch(mostOfTiles, at, 0);
      uint bits = bitsOf(there.a);
      near |= away <= kShadedReach ? bits : 0u;
      far |= away <= kBlurredReach ? bits : 0u;
      around |= away <= kMovedReach ? bits : 0u;
      if (away <= kTearReach) {
        beside |= bits;
        least = min(least, texelFetch(leastOfTiles, at, 0).rgb);
        most = max(most, there.rgb);
      }
    }
  vec4 ownMost = texelFetch(mostOfTiles, ivec3(tile, layer), 0);
  uint own = bitsOf(ownMost.a);
  vec3 range = most - least;
  bool isCovered = (own & kFoundCovered) != 0u, differs = max(range.r, max(range.g, range.b)) > kSeenStep;
  bool isIndicated = hasMarks && (own & kFoundIndicated) != 0u;
  uint flags = 0u;
  if (isCovered) flags |= kTileCovered;
  bool isShaded = (near & kEdge) == kEdge || isIndicated;
  if (isCovered && isShaded) flags |= kTileShaded;
  // Colours were not compared where something else has told that there are edges.
  vec3 ownRange = ownMost.rgb - texelFetch(leastOfTiles, ivec3(tile, layer), 0).rgb;
  bool isMixed = (kWanted & kWantsMixed) != 0 && isCovered &&
                 (max(ownRange.r, max(ownRange.g, ownRange.b)) > kSeenStep ||
                  (own & (kFoundOpen | kFoundFar | kFoundIndicated)) != 0u || (own & kEdge) == kEdge);
  if (isMixed) flags |= kTileMixed;
  if (!isShaded && !isMixed && (own & (kFoundOpen | kFoundFar)) == 0u) flags |= kTilePlain;
  if ((own & kFoundNotDark) != 0u) flags |= kTileLit;
  if ((far & kEdge) == kEdge || (hasMarks && (far & kFoundIndicated) != 0u)) flags |= kTileBlurred;
  if (hasTears) {
    bool isEdge = differs || (beside & (kFoundOpen | kFoundFar | kFoundIndicated)) != 0u || (around & kEdge) == kEdge;
    bool isNear = (beside & kFoundCovered) != 0u;
    if (tearsEverywhere || (isNear && (tearsAll || isEdge))) flags |= kTileTorn;
  }
  return vec4(channelOf(flags), 0.0, 0.0, 0.0);
}

#define OUTPUT_FORMAT rgba8
#include "../../shading/image_pass.glsl"
