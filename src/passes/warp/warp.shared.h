#ifndef SCUMBLE_WARP_SHARED_H
#define SCUMBLE_WARP_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN
// Specialisation constant 0 of the image step: what its setup needs, so that others do not pay for it.
const int kWarpApart = 1;      // the breakup map is not in the blue channel of the same texture
const int kWarpHistogram = 2;  // a Gaussian twin
const int kWarpUnusual =
    4;  // another mode than MetaTexture, another base than 2, rotation, orientation to contour
const int kWarpSkip = 8;      // samples are skipped
const int kWarpWrap = 16;     // a mapping closes on itself
const int kWarpSeveral = 32;  // there are other setups: most pixels are another's
// Specialisation constant 4 of the geometry step: what any material needs.
const int kWarpFragmentGradients = 1;
const int kWarpRadial = 2;
const int kWarpDistance = 4;
SHARED_END
#endif
