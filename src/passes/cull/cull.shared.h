#ifndef SCUMBLE_CULL_SHARED_H
#define SCUMBLE_CULL_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN
const int kCullThreads = 64;

// What draws a level of detail.
const int kLevelSeen = 0, kLevelTorn = 1, kLevelCasts = 2;
// The inflated surface may be off by so many times the error: the tear hides it.
const float kTearHides = 2.0;

struct CullUniforms {
  vec2 margin;        // how far what is outside may reach in, in normalised device coordinates
  uint draws;         // in the list
  uint bucketShift;   // key = bucket << bucketShift | unseen << (bucketShift - 1) | distance
  float error;        // of a level of detail: pixels, and texels of the shadow map
  float rigRadius;    // metres that an eye stands from the middle of all, at most
  float longestEdge;  // of shadow casters, metres: the shadow map bends longer ones
  float mapSize;      // texels of the shadow map
  uint textures;      // kTexturesColor where the look gives materials textures
};
SHARED_END
#endif
