#ifndef SCUMBLE_COLOR_SHARED_H
#define SCUMBLE_COLOR_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN
// Bindings of set 1.
const int kColorLight = 1, kColorLit = 2, kColorShadowed = 3, kColorDepth = 4, kColorSampleLight = 5,
          kColorLitSamples = 6, kColorShadowedSamples = 7, kColorDepthSamples = 8;
SHARED_END
#endif
