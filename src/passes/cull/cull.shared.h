#ifndef SCUMBLE_CULL_SHARED_H
#define SCUMBLE_CULL_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN
const int kCullThreads = 64;

struct CullUniforms {
  vec2 margin;       // how far what is outside may reach in, in normalised device coordinates
  uint draws;        // in the list
  uint bucketShift;  // key = bucket << bucketShift | unseen << (bucketShift - 1) | distance
};
SHARED_END
#endif
