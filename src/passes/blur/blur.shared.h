#ifndef SCUMBLE_BLUR_SHARED_H
#define SCUMBLE_BLUR_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN
struct BlurStep {
  uint vertical;
  int halving;    // 1: the output is half as large along the axis
  int reach;      // taps on each side, source texels
  float falloff;  // 1 / (2 sigma^2), source texels
  float depthFalloff;  // 1 / (2 sigma^2), of relative depth
  uint first;          // 1: depth comes from the depth buffer, else from B
};
SHARED_END
#endif
