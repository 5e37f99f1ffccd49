#version 460
// Exclusive prefix sums in blocks: each block's numbers become the sums of those before them in the block, and its sum goes
// to the level above. With kAdds, what the level above has become is added to each block.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "prefix_sum.shared.h"

layout(constant_id = 0) const bool kAdds = false;

layout(local_size_x = kSumThreads) in;
layout(set = 0, binding = 0, scalar) buffer Values { uint values[]; };
layout(set = 0, binding = 1, scalar) buffer Above { uint above[]; };
layout(push_constant, scalar) uniform Push { uint count; };

shared uint sums[kSumThreads];

void main() {
  uint thread = gl_LocalInvocationID.x, block = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  uint first = block * kSumBlock + thread * kSumRun;
  if (kAdds) {
    for (uint i = first; i < min(first + kSumRun, count); ++i) values[i] += above[block];
    return;
  }

  uint sum = 0;
  for (uint i = first; i < min(first + kSumRun, count); ++i) sum += values[i];
  sums[thread] = sum;
  barrier();
  // One thread goes through the few sums: barriers cost CPU drivers more.
  if (thread == 0)
    for (uint i = 0, before = 0; i < kSumThreads; ++i) {
      uint own = sums[i];
      sums[i] = before;
      before += own;
    }
  barrier();
  uint running = sums[thread];
  for (uint i = first; i < min(first + kSumRun, count); ++i) {
    uint value = values[i];
    values[i] = running;
    running += value;
  }
  if (thread == kSumThreads - 1 && block * kSumBlock < count) above[block] = running;
}
