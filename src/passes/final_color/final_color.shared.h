#ifndef SCUMBLE_FINAL_COLOR_SHARED_H
#define SCUMBLE_FINAL_COLOR_SHARED_H
#include "../../shading/backdrop.shared.h"
#include "../../shading/displacement.shared.h"
#include "../../shading/surface_color.shared.h"

SHARED_BEGIN
// Bindings of set 1.
const int kFinalColorColor = 1, kFinalColorWarp = 2, kFinalColorDepth = 3, kFinalColorBloom = 4,
          kFinalColorBehind = 5, kFinalColorBehindDepth = 6, kFinalColorLight = 7, kFinalColorLit = 8,
          kFinalColorBehindLight = 9, kFinalColorBehindLit = 10, kFinalColorBackdrop = 11,
          kFinalColorTear = 12, kFinalColorInflated = 13;
// Of colours that are made here: in the place of the colours, the resolved depth; in that of the depth, its
// samples; and in those of the pictures' and others:
const int kFinalColorShadowed = 9, kFinalColorSampleLight = 10, kFinalColorLitSamples = 11,
          kFinalColorShadowedSamples = 12, kFinalColorGraded = 14, kFinalColorUngraded = 15,
          kFinalColorBlended = 16, kFinalColorBlendedDistance = 17;

// Specialisation constant 0.
const int kFinalColorGlows = 1;        // anything in the scene acts on the lens
const int kFinalColorTorn = 2;         // else each pixel keeps its own colour
const int kFinalColorMixes = 4;        // a pixel's colour is that of several samples
const int kFinalColorGlowColor = 8;    // the inner glow has a colour of its own
const int kFinalColorIsGraded = 16;    // colours of surfaces have been changed since
const int kFinalColorHasBlended = 32;  // there are blended surfaces in air

struct FinalColorUniforms {
  vec3 bloom;  // colour times amount
  Displacement displacement;
  vec2 tearMean;  // of the pattern that tears the picture behind everything
  Backdrop backdrop;
};

// Of colours that are made here.
struct SampledColorUniforms {
  vec3 bloom;
  Displacement displacement;
  SurfaceColors colors;
};
SHARED_END
#endif
