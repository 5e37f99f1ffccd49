#version 460
// Which edges are lines: looks at every edge once, a workgroup a chunk, and leaves a bit for each (FORMULAS 25).
#extension GL_GOOGLE_include_directive : require
#include "../ink_edge.glsl"

layout(local_size_x = kInkThreads) in;
layout(set = 1, binding = kInkWords, scalar) writeonly buffer Words { uint words[]; };
layout(set = 1, binding = kInkSums, scalar) writeonly buffer Sums { uint sums[]; };
layout(push_constant, scalar) uniform Push { uint chunkCount; };

shared uint found[kInkWordsOfChunk];

void main() {
  uint chunkIndex = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x, thread = gl_LocalInvocationID.x;
  if (chunkIndex >= chunkCount) return;
  EdgeChunk chunk = chunks[chunkIndex];
  found[thread] = 0u;
  barrier();
  for (uint word = 0; word * kInkThreads < chunk.count; ++word) {
    uint number = word * kInkThreads + thread;
    if (number >= chunk.count) continue;
    PlacedEdge edge = placed(edges[chunk.firstEdge + number], chunk.firstVertex);
    bool isLine = kindOf(edge, eyeOf(0)) != kInkNone;
    if (kViewCount > 1 && !kCyclopean && !isLine) isLine = kindOf(edge, eyeOf(1)) != kInkNone;
    if (isLine) atomicOr(found[word], 1u << thread);
  }
  barrier();
  words[chunkIndex * kInkWordsOfChunk + thread] = found[thread];
  sums[chunkIndex * kInkWordsOfChunk + thread] = bitCount(found[thread]);
  // One beyond the last becomes the sum of all.
  if (chunkIndex == chunkCount - 1 && thread == 0u) sums[chunkCount * kInkWordsOfChunk] = 0u;
}
