#ifndef SCUMBLE_FINAL_COLOR_SHARED_H
#define SCUMBLE_FINAL_COLOR_SHARED_H
#include "../../shading/backdrop.shared.h"
#include "../../shading/displacement.shared.h"

SHARED_BEGIN
struct FinalColorUniforms {
  vec3 bloom;  // colour times amount
  Displacement displacement;
  vec2 tearMean;  // of the pattern that tears the picture behind everything
  Backdrop backdrop;
};
SHARED_END
#endif
