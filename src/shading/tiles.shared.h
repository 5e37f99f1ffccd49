// Tiles: squares of the picture, by which steps tell where there is something for them to do.
#ifndef SCUMBLE_TILES_SHARED_H
#define SCUMBLE_TILES_SHARED_H
#include "shared_types.h"

SHARED_BEGIN
const int kTileSize = 16;  // pixels
const int kTileBlock = 4;  // tiles

// Flags of a tile, of the first surfaces. An image of flags, rgba8, has a texel a tile. R: the tile's
// (byte_bits.glsl); G, B: those that all tiles of its block have, and those that any has.
const uint kTileCovered = 1u;  // something is there
const uint kTilePlain = 2u;   // everything is covered wholly, nothing is shaded, no air lies before it; where
                              // pixels have several samples, nothing is mixed or marked either
const uint kTileShaded = 4u;  // covered, and neither all in light nor all in shadow as far as blurred light
                              // comes from; or indication may act
const uint kTileLit = 8u;     // something is in light; where it is plain, everything
const uint kTileBlurred = 16u;  // what is blurred here counts for a tile that is shaded
const uint kTileTorn = 32u;     // colours may differ as far as the warp moves them
const uint kTileMarked = 64u;   // the warp's pattern counts: for tears, or for marks
const uint kTileMixed = 128u;   // samples of a pixel may have different colours; where it has several

// Pushed with a job that runs on some tiles: on those whose flags under `mask` are `value`.
struct TileRule {
  int firstView;  // as ViewBlock has it
  uint mask, value;
  int across;   // tiles
  vec2 extent;  // of a tile in normalised device coordinates of the output
  vec2 pixels;  // that a texel of the output is wide and high
};
SHARED_END
#endif
