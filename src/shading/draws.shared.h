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

const uint kTexturesColor = 1u, kTexturesCut = 2u;  // cut: holes

// What decides whether a draw is seen, and when it comes: a box around it (world), and its bucket.
struct DrawPlace {
  vec3 low, high;  // low.x above high.x: it is empty
  uint bucket;
  uint firstLevel, levels;  // of its levels of detail, from the finest on
  float scale;              // metres for each one of the mesh, at most
  uint textures;            // what they do there: kTexturesColor, kTexturesCut
  uint isClosed;            // 1: its triangles close, so that from outside of it nobody sees a back
};

// An object as a frame draws it.
struct DrawnObject {
  float sunken;     // metres that it lies inside of itself at most, with the detail that it is drawn with
  uint hidesBacks;  // 1: its front sides cover all of its back sides, for all eyes
};

// Fewer triangles than its command has; lengths in mesh space.
struct DrawLevel {
  uint firstIndex, indexCount;
  float error, textureError, shadowError, longestEdge;
};

SHARED_END
#endif
