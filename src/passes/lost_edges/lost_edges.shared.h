#ifndef SCUMBLE_LOST_EDGES_SHARED_H
#define SCUMBLE_LOST_EDGES_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN
const int kLostPicture = 1, kLostWarp = 2;  // bindings of set 1

// Places along a mark, of each side, whose colours run into a pixel's.
const int kLostSteps = 3;

struct LostEdgesUniforms {
  float amount;     // 0 to 1
  float values;     // difference of OKLab lightness from which an edge is found
  float width;      // pixels: how far colours run
  float wholeTear;  // pixels: where edges are torn so far, colours run all of the way
};
SHARED_END
#endif
