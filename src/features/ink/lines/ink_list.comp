#version 460
// Numbers of lines, in the order of edges, and how many vertices draw them.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "../ink.shared.h"

layout(local_size_x = kInkThreads) in;
layout(set = 1, binding = kInkWords, scalar) readonly buffer Words { uint words[]; };
layout(set = 1, binding = kInkSums, scalar) readonly buffer Sums { uint sums[]; };
layout(set = 1, binding = kInkNumbers, scalar) writeonly buffer Numbers { uint numbers[]; };
layout(set = 1, binding = kInkCommand, scalar) writeonly buffer Command { InkCommand command; };
layout(push_constant, scalar) uniform Push { uint chunkCount; };

void main() {
  uint group = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (group >= chunkCount) return;
  uint word = group * kInkThreads + gl_LocalInvocationID.x;
  uint bits = words[word], next = sums[word];
  while (bits != 0u) {
    int bit = findLSB(bits);
    bits &= bits - 1u;
    numbers[next++] = word * kInkThreads + uint(bit);
  }
  if (word == 0u) {
    uint lines = sums[chunkCount * kInkWordsOfChunk];
    uint groups = (min(lines, uint(kInkRoom)) + kInkThreads - 1) / kInkThreads;
    command = InkCommand(6u * lines, 1u, 0u, 0u, groups, 1u, 1u);
  }
}
