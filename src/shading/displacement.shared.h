// What decides from where the picture takes a pixel's colour, besides the warp's own vectors.
#ifndef SCUMBLE_DISPLACEMENT_SHARED_H
#define SCUMBLE_DISPLACEMENT_SHARED_H
#include "shared_types.h"

SHARED_BEGIN
// For a specialisation constant.
const int kRipplePaper = 0, kRippleDepthAware = 1, kRippleLayered = 2;
// No vector is longer than this times the amount; of those of the examples that are built in, one in a
// thousand would be.
const float kFarthestTear = 2.0;
struct Displacement {
  float inflation;  // pixels, the most of any material
};
SHARED_END
#endif
