#ifndef SCUMBLE_FINAL_COLOR_SHARED_H
#define SCUMBLE_FINAL_COLOR_SHARED_H
#include "../../shading/displacement.shared.h"

SHARED_BEGIN
struct FinalColorUniforms {
  vec3 bloom;  // colour times amount
  Displacement displacement;
};
SHARED_END
#endif
