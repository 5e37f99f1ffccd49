#ifndef SCUMBLE_BLUR_SHARED_H
#define SCUMBLE_BLUR_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN
// Bindings of set 1.
const int kBlurSource = 1, kBlurDepth = 2;

const int kMaxBlurTaps = 64;
struct BlurStep {
  ivec2 axis;            // (1, 0) or (0, 1)
  ivec2 scale;           // source texels an output pixel, per axis of the image
  int factor;            // the same along `axis`
  int firstTap;          // relative to the output pixel's first source texel
  float depthSharpness;  // a tap at relative depth z counts 1 / (1 + sharpness z^2)^2 of its weight
  float weights[kMaxBlurTaps];
};
SHARED_END
#endif
