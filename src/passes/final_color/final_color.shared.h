#ifndef SCUMBLE_FINAL_COLOR_SHARED_H
#define SCUMBLE_FINAL_COLOR_SHARED_H
#include "../../shading/backdrop.shared.h"
#include "../../shading/displacement.shared.h"

SHARED_BEGIN
// Bindings of set 1.
const int kFinalColorColor = 1, kFinalColorWarp = 2, kFinalColorDepth = 3, kFinalColorBlurred = 4,
          kFinalColorBehind = 5, kFinalColorBehindDepth = 6, kFinalColorLight = 7, kFinalColorLit = 8,
          kFinalColorBehindLight = 9, kFinalColorBehindLit = 10, kFinalColorBackdrop = 11,
          kFinalColorTear = 12, kFinalColorInflated = 13;

// Specialisation constant 0.
const int kFinalColorGlows = 1;  // anything in the scene acts on the lens
const int kFinalColorTorn = 2;   // else each pixel keeps its own colour

struct FinalColorUniforms {
  vec3 bloom;  // colour times amount
  Displacement displacement;
  vec2 tearMean;  // of the pattern that tears the picture behind everything
  Backdrop backdrop;
};
SHARED_END
#endif
