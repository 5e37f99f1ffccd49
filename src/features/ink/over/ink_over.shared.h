#ifndef SCUMBLE_INK_OVER_SHARED_H
#define SCUMBLE_INK_OVER_SHARED_H
#include "../../../shading/shared_types.h"

SHARED_BEGIN
struct InkOverUniforms {
  float warp;  // how far the warp moves ink, against other edges
  // Of lines around shadow shapes.
  float shadowRadius;  // pixels; where widths are in metres, at a distance of one
  vec3 shadowColor;    // square root
};
const int kInkOverPicture = 1, kInkOverStrokes = 2, kInkOverWarp = 3, kInkOverTiles = 4, kInkOverLight = 5,
          kInkOverDepth = 6;
SHARED_END
#endif
