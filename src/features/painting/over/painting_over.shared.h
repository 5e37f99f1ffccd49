#ifndef SCUMBLE_PAINTING_OVER_SHARED_H
#define SCUMBLE_PAINTING_OVER_SHARED_H
#include "../../../shading/shared_types.h"

SHARED_BEGIN
struct PaintingOverUniforms {
  float warp;  // how far the warp moves paint, against other edges
};
const int kPaintingOverPicture = 1, kPaintingOverPaint = 2, kPaintingOverWarp = 3, kPaintingOverTiles = 4;
SHARED_END
#endif
