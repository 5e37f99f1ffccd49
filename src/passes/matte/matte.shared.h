#ifndef SCUMBLE_MATTE_SHARED_H
#define SCUMBLE_MATTE_SHARED_H
#include "../../shading/displacement.shared.h"

SHARED_BEGIN
struct MatteMaterial {
  float simplify;  // of textures, in mip levels
};
struct MatteUniforms {
  Displacement displacement;
};
SHARED_END
#endif
