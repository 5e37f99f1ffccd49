// The waves of a moment, as deform and the surface pass read them.
#ifndef SCUMBLE_OCEAN_SHARED_H
#define SCUMBLE_OCEAN_SHARED_H
#include "shared_types.h"

SHARED_BEGIN

const float kWaterPerPattern = 10.0f;  // metres for one unit of pattern coordinates

// A point of the tile's grid.
struct OceanPoint {
  vec3 displacement;  // metres
  float jacobian;     // of the horizontal displacement: 1 in calm, less where crests are drawn together
  vec3 normal;
};

struct OceanField {
  ivec2 first;               // the grid point at which the mesh's corner point of the middle tile is
  ivec2 travelled;           // points by which the water has slid, from 0 to the grid
  int grid;                  // points along a tile
  float cell;                // metres between them
  vec3 origin;               // middle of calm water, world
  float fadeStart, fadeEnd;  // metres from there: waves are whole, and gone
  float sink;                // how far water that has no waves lies below
  float deviation;           // of the height, metres
};

SHARED_END
#endif
