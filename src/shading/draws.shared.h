// The list of draws, from which the device finds what a frame draws.
#ifndef SCUMBLE_DRAWS_SHARED_H
#define SCUMBLE_DRAWS_SHARED_H
#include "shared_types.h"

SHARED_BEGIN

// As VkDrawIndexedIndirectCommand has it.
struct DrawCommand {
  uint indexCount, instanceCount, firstIndex;
  int vertexOffset;
  uint firstInstance;  // the object
};

// What decides whether a draw is seen, and when it comes: a box around it (world), and its bucket.
struct DrawPlace {
  vec3 low, high;  // low.x above high.x: it is empty
  uint bucket;
};

SHARED_END
#endif
