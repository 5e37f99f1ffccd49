#ifndef SCUMBLE_TILE_STEPS_SHARED_H
#define SCUMBLE_TILE_STEPS_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN
// Bindings of set 1: of the step that looks at pixels; of those that gather what it found, and flags.
const int kTileShadow = 1, kTileLitColor = 2, kTileShadowedColor = 3, kTileDepth = 4;
const int kTileLeast = 1, kTileMost = 2;
const int kTileOwnFlags = 1;

// What is found in pixels, in bits of the alpha of `most`.
const uint kFoundCovered = 1u, kFoundOpen = 2u;  // something covers it; not all of it
const uint kFoundNotLit = 4u, kFoundNotDark = 8u, kFoundIndicated = 16u;
const uint kFoundFar = 32u;  // in the air, which colours by distance

// Bits of kWanted, a specialisation constant.
const int kWantsTears = 1, kWantsMarks = 2;  // there are any
const int kTearsAll = 4;                     // wherever a surface is near
const int kTearsEverywhere = 8;              // surfaces may be anywhere near
const int kWantsMixed = 16;                  // pixels have several samples
const int kFarthestTile = 16;                // that is looked at for tears

// Two colours whose roots differ by less look the same.
const float kSeenStep = 2.5 / 255.0;

struct TilePixels {
  float airStart;  // metres along the view axis
};
SHARED_END
#endif
