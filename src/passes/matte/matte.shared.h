#ifndef SCUMBLE_MATTE_SHARED_H
#define SCUMBLE_MATTE_SHARED_H
#include "../../shading/displacement.shared.h"

SHARED_BEGIN
// Bindings of set 1 of the image step.
const int kMatteObjects = 1, kMatteWarp = 2, kMatteDepth = 3, kMatteBehind = 4, kMatteBehindDepth = 5,
          kMatteInflated = 6, kMatteTiles = 7, kMatteDepthSamples = 8;

struct MatteMaterial {
  float simplify;  // of textures, in mip levels
};
struct MatteUniforms {
  Displacement displacement;
};
SHARED_END
#endif
