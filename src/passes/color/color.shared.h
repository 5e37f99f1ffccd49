#ifndef SCUMBLE_COLOR_SHARED_H
#define SCUMBLE_COLOR_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN
// Bindings of set 1.
const int kColorLight = 1, kColorLit = 2, kColorShadowed = 3, kColorDepth = 4, kColorBlended = 5,
          kColorBlendedDistance = 6, kColorSampleLight = 7, kColorLitSamples = 8, kColorShadowedSamples = 9,
          kColorDepthSamples = 10;
SHARED_END
#endif
