#ifndef SCUMBLE_BLOOM_SHARED_H
#define SCUMBLE_BLOOM_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN
const int kBloomSource = 1;  // binding of set 1

const int kFarthestBloomTap = 64;  // texels of a quarter of the size
struct BloomStep {
  ivec2 axis;                            // (1, 0) or (0, 1)
  float weights[kFarthestBloomTap + 1];  // of texels that are so far away
};
SHARED_END
#endif
