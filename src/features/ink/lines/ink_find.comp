#version 460
// Which edges are lines: a workgroup a chunk, which leaves a bit for each (FORMULAS 25). Words of edges of which none can be one
// are left out, by their bounds; every other edge is looked at once.
#extension GL_GOOGLE_include_directive : require
#include "../edge_bounds.shared.h"
#include "../ink_edge.glsl"

layout(local_size_x = kInkThreads) in;
layout(set = 1, binding = kInkWords, scalar) writeonly buffer Words { uint words[]; };
layout(set = 1, binding = kInkSums, scalar) writeonly buffer Sums { uint sums[]; };
layout(set = 1, binding = kInkBounds, scalar) readonly buffer Bounds { EdgeBounds bounds[]; };
layout(push_constant, scalar) uniform Push { uint chunkCount; };

shared uint found[kInkWordsOfChunk];
// Numbers of words that are looked at.
shared uint opened[kInkWordsOfChunk], openedCount;

const bool kHasTwoEyes = kViewCount > 1 && !kCyclopean;

// What eyeOf() is in the space of a mesh, by Cramer's rule: an inverse matrix takes longer.
vec4 inMesh(mat4 model, vec4 eye) {
  vec3 x = model[0].xyz, y = model[1].xyz, z = model[2].xyz, there = eye.xyz - eye.w * model[3].xyz;
  vec3 yz = cross(y, z);
  return vec4(vec3(dot(yz, there), dot(cross(z, x), there), dot(cross(x, y), there)) / dot(x, yz), eye.w);
}

// Whether nothing tells that a word has no lines.
bool mayHaveLines(EdgeChunk chunk, uint word) {
  if (word * kInkThreads >= chunk.count) return false;
  if (chunk.firstBounds == kNoEdgeBounds) return true;
  EdgeBounds b = bounds[chunk.firstBounds + word];
  uint kinds = (isShown(kInkBoundary) ? kEdgeOpen : 0u) | (isShown(kInkMaterial) ? kEdgeMaterialBorder : 0u) |
               (isShown(kInkColor) ? kEdgeColorBorder : 0u);
  if ((b.kinds & kinds) != 0u) return true;
  mat4 model = objects[chunk.object].model;
  if (isShown(kInkCrease)) {
    // Angles stay what they are where nothing is stretched.
    mat3 m = mat3(model);
    vec3 sizes = vec3(dot(m[0], m[0]), dot(m[1], m[1]), dot(m[2], m[2]));
    vec3 skews = abs(vec3(dot(m[0], m[1]), dot(m[1], m[2]), dot(m[2], m[0])));
    float most = max(sizes.x, max(sizes.y, sizes.z)), least = min(sizes.x, min(sizes.y, sizes.z));
    bool isStretched = most - least + max(skews.x, max(skews.y, skews.z)) > 1e-3 * most;
    if (isStretched || b.cosBend < ink.cosCrease + 2e-3) return true;
  }
  if (!isShown(kInkSilhouette)) return false;
  bool areAlike = allFaceAlike(b, inMesh(model, eyeOf(0)));
  if (kHasTwoEyes) areAlike = areAlike && allFaceAlike(b, inMesh(model, eyeOf(1)));
  return !areAlike;
}

void main() {
  uint chunkIndex = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x, thread = gl_LocalInvocationID.x;
  if (chunkIndex >= chunkCount) return;
  EdgeChunk chunk = chunks[chunkIndex];
  found[thread] = 0u;
  if (thread == 0u) openedCount = 0u;
  barrier();
  if (mayHaveLines(chunk, thread)) opened[atomicAdd(openedCount, 1u)] = thread;
  barrier();
  for (uint i = 0; i < openedCount; ++i) {
    uint word = opened[i], number = word * kInkThreads + thread;
    if (number >= chunk.count) continue;
    PlacedEdge edge = placed(edgeOf(chunk.firstEdge + number), chunk.firstVertex);
    bool isLine = kindOf(edge, eyeOf(0)) != kInkNone;
    if (kHasTwoEyes && !isLine) isLine = kindOf(edge, eyeOf(1)) != kInkNone;
    if (isLine) atomicOr(found[word], 1u << thread);
  }
  barrier();
  words[chunkIndex * kInkWordsOfChunk + thread] = found[thread];
  sums[chunkIndex * kInkWordsOfChunk + thread] = bitCount(found[thread]);
  // One beyond the last becomes the sum of all.
  if (chunkIndex == chunkCount - 1 && thread == 0u) sums[chunkCount * kInkWordsOfChunk] = 0u;
}
