// Volumes that cut holes into what a feature draws (shading/cutouts.glsl).
#ifndef SCUMBLE_CUTOUTS_SHARED_H
#define SCUMBLE_CUTOUTS_SHARED_H
#include "shared_types.h"

SHARED_BEGIN
const int kMaxCutouts = 16;
// Cells from a volume's border at which its numbers are -1 and 1.
const float kCutoutReach = 1.5;
// Cells around that border within which sides are taken to hide what is cut too far, or not far enough.
const float kCutoutMargin = 0.25;

struct Cutout {
  mat4 toPoints;  // from the world to numbers of the grid's points
  vec3 size;      // points
  float ceiling;  // number of a point above which nothing is cut
  int first;      // word of its first point
};

struct Cutouts {
  int count;
  Cutout all[kMaxCutouts];
};
SHARED_END
#endif
