#ifndef SCUMBLE_FINAL_COLOR_SHARED_H
#define SCUMBLE_FINAL_COLOR_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN
struct FinalColorUniforms {
  vec3 bloom;       // colour times amount
  float inflation;  // pixels, the most of any material
  int ripple;       // 0 paper, 1 depth-aware, 2 layered
};
SHARED_END
#endif
