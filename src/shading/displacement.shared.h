// What decides from where the picture takes a pixel's colour, besides the warp's own vectors.
#ifndef SCUMBLE_DISPLACEMENT_SHARED_H
#define SCUMBLE_DISPLACEMENT_SHARED_H
#include "shared_types.h"

SHARED_BEGIN
struct Displacement {
  float inflation;  // pixels, the most of any material
  int ripple;       // 0 paper, 1 depth-aware, 2 layered
};
SHARED_END
#endif
