#ifndef SCUMBLE_WARP_SHARED_H
#define SCUMBLE_WARP_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN
// Bindings of set 1 of the image steps.
const int kWarpPattern = 1, kWarpKnobs = 2, kWarpDepth = 3, kWarpFieldExample = 4, kWarpFieldInverse = 5,
          kWarpMarksExample = 6, kWarpMarksInverse = 7;

// The material's constant of the geometry step.
const int kWarpFades = 1;    // far things are torn less
const int kWarpFollows = 2;  // the pattern follows the mapping, by MetaTexture

// Specialisation constant 0 of the image step: what is asked of them, so that nobody pays for more.
const int kWarpVectors = 1;
const int kWarpMarks = 2;
const int kWarpApart = 4;             // marks are not in the blue channel of the vectors' texture
const int kWarpSeveral = 8;           // there are other setups: most pixels are another's
const uint kMostWarpSetups = 16383u;  // what comes after them takes the last one's
SHARED_END
#endif
