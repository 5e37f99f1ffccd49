#ifndef SCUMBLE_WARP_SHARED_H
#define SCUMBLE_WARP_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN
// Bindings of set 1 of the image step.
const int kWarpPattern = 1, kWarpKnobs = 2, kWarpDepth = 3, kWarpFieldExample = 4, kWarpFieldInverse = 5,
          kWarpMarksExample = 6, kWarpMarksInverse = 7;

// Specialisation constant 0 of the image step: what its setup needs, so that others do not pay for it.
const int kWarpApart = 1;    // the breakup map is not in the blue channel of the same texture
const int kWarpSeveral = 2;  // there are other setups: most pixels are another's
// No vector is longer than this times the amount; of those of the examples that are built in, one in a
// thousand would be.
const float kFarthestTear = 2.0;
SHARED_END
#endif
