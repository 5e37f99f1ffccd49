#ifndef SCUMBLE_FINAL_COLOR_SHARED_H
#define SCUMBLE_FINAL_COLOR_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN
struct FinalColorUniforms {
  vec3 bloom;  // colour times amount
  int ripple;  // 0 paper, 1 depth-aware
};
SHARED_END
#endif
