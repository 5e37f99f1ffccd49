// What decides from where the picture takes a pixel's colour, besides the warp's own vectors.
#ifndef SCUMBLE_DISPLACEMENT_SHARED_H
#define SCUMBLE_DISPLACEMENT_SHARED_H
#include "shared_types.h"

SHARED_BEGIN
// For a specialisation constant.
const int kRipplePaper = 0, kRippleDepthAware = 1, kRippleLayered = 2;
struct Displacement {
  float inflation;  // pixels, the most of any material
};
SHARED_END
#endif
