#ifndef SCUMBLE_FINAL_COLOR_SHARED_H
#define SCUMBLE_FINAL_COLOR_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN
struct FinalColorUniforms {
  vec3 bloom;  // colour times amount
  int ripple;  // 0 paper, 1 depth-aware
  int glows;   // 1 where anything acts on the lens, else 0
};
SHARED_END
#endif
