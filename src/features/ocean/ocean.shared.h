// The waves of a moment, as deform and the surface pass read them.
#ifndef SCUMBLE_OCEAN_SHARED_H
#define SCUMBLE_OCEAN_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN

// ObjectData::kind: waves move it; flat water beyond them; a wake, ripples or a splash, of which
// ObjectData::detail says which one in OceanField; a mesh of the scene that lies on the water.
const uint kWaves = 1, kFlat = 2, kDecoration = 3, kDraped = 4;

const float kWaterPerPattern = 10.0f;  // metres for one unit of pattern coordinates

// A point of the tile's grid.
struct OceanPoint {
  vec3 displacement;  // metres
  float jacobian;     // of the horizontal displacement: 1 in calm, less where crests are drawn together
  vec3 normal;
};

// What lies on the water: a wake, ripples or a splash (paper 000, section 6.2).
// Places are metres from the middle of calm water, along x and z, where the surface would be without waves.
const int kWake = 0, kRipples = 1, kSplash = 2;
const int kMaxDecorations = 16, kDecorationPoints = 26;
struct WaterDecoration {
  int kind;
  int count;                     // of points
  float amount;                  // from 0 to 1
  float foam, height;            // factors
  float lasts;                   // seconds
  vec2 center;                   // a circle around all that it draws
  float reach;                   // its radius, metres
  float hull, halfBeam, spread;  // of a wake: metres, metres, tangent
  float rise;                    // of its waves, metres
  float radius, crests;          // of ripples and splashes
  // Of a wake, from the bow back along its path: x, z, metres behind the bow, how much there is. Of the
  // others, each time that they have begun: x, z, seconds ago, a number from 0 to 1 of its own.
  vec4 points[kDecorationPoints];
};

// The water below a mesh of the scene that lies on it, as if it were calm: a rectangle, along x and z.
const int kMaxZones = 64;
const float kDrapedLift = 0.02f;  // metres by which such a mesh lies above the water
struct WaterZone {
  vec2 center;  // metres from the middle of calm water
  vec2 along;   // direction of its first side
  vec2 halves;  // of its sides, metres
  float calm;   // how far strokes are suppressed, from 0 to 1
  float room;   // factor on how far the mesh is pushed down
};

// The water around a hull is no higher than its rim, and rises from there: what is cut out of it within
// (hulls/hulls.h) would else have no side where it ends (paper 000, section 6.2: the base mesh is pushed down
// around the boat).
const int kMaxBasins = 16, kBasinPoints = 24;
const float kBasinSlope = 0.7f;
struct WaterBasin {
  int count;     // of points
  float margin;  // metres around a point of the rim within which water is no higher than that
  float most;    // metres that water is taken down at most
  vec2 center;  // a circle around all that is taken down: metres from the middle of calm water, along x and z
  float reach;  // its radius, metres
  vec3 rim[kBasinPoints];  // metres from the middle of calm water
};

struct OceanField {
  ivec2 first;               // the grid point at which the mesh's corner point of the middle tile is
  ivec2 travelled;           // points by which the water has slid, from 0 to the grid
  int grid;                  // points along a tile
  float cell;                // metres between them
  vec3 origin;               // middle of calm water, world
  float fadeStart, fadeEnd;  // metres from there: waves are whole, and gone
  float sink;                // how far water that has no waves lies below
  float relief;  // metres of height that count as one in the colours: waves' deviation, and a little
  vec2 within;   // metres by which the mesh lies before its points: less than a cell
  float push;    // how far the mesh is pushed down below decorations, metres
  int decorationCount;
  WaterDecoration decorations[kMaxDecorations];
  int zoneCount;
  WaterZone zones[kMaxZones];
  int basinCount;
  WaterBasin basins[kMaxBasins];
};

SHARED_END
#endif
