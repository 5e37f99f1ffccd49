#ifndef SCUMBLE_INK_OVER_SHARED_H
#define SCUMBLE_INK_OVER_SHARED_H
#include "../../../shading/shared_types.h"

SHARED_BEGIN
struct InkOverUniforms {
  float warp;  // how far the warp moves ink, against other edges
};
const int kInkOverPicture = 1, kInkOverStrokes = 2, kInkOverWarp = 3, kInkOverTiles = 4;
SHARED_END
#endif
