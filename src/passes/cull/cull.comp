#version 460
// Before the sort: each draw's key, by its bucket, whether a view sees it, and how far it is. After it (kGathers): the
// commands in the order of the keys.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/distance_key.glsl"
#include "../../shading/draws.shared.h"
#include "cull.shared.h"

layout(constant_id = kPassId) const bool kGathers = false;

layout(local_size_x = kCullThreads) in;
layout(set = 1, binding = 0, scalar) uniform Cull { CullUniforms cull; };
layout(set = 1, binding = 1, scalar) readonly buffer Commands { DrawCommand commands[]; };
layout(set = 1, binding = 2, scalar) readonly buffer Places { DrawPlace places[]; };
layout(set = 1, binding = 3, scalar) buffer Keys { uint keys[]; };
layout(set = 1, binding = 4, scalar) buffer Order { uint order[]; };
layout(set = 1, binding = 5, scalar) writeonly buffer Seen { DrawCommand seen[]; };

// As stage/visibility.h has it.
bool mayBeSeen(DrawPlace place, mat4 worldToClip) {
  // Planes as rows of the matrix: what is seen has -w <= x, y <= w and 0 <= z <= w.
  mat4 rows = transpose(worldToClip);
  vec2 reach = 1.0 + cull.margin;
  vec4 planes[6] = {reach.x * rows[3] + rows[0], reach.x * rows[3] - rows[0], reach.y * rows[3] + rows[1],
                    reach.y * rows[3] - rows[1], rows[2],                     rows[3] - rows[2]};
  vec3 center = 0.5 * (place.low + place.high), halfSize = 0.5 * (place.high - place.low);
  bool isOutside = false;
  // Written so that what is not finite is seen.
  for (int p = 0; p < 6; ++p)
    isOutside = isOutside || dot(planes[p].xyz, center) + planes[p].w + dot(abs(planes[p].xyz), halfSize) < 0.0;
  return !isOutside && !(place.low.x > place.high.x);
}

void main() {
  uint i = (gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x) * kCullThreads + gl_LocalInvocationID.x;
  if (i >= cull.draws) return;
  uint unseenBit = 1u << (cull.bucketShift - 1u);
  if (kGathers) {
    DrawCommand command = commands[order[i]];
    if ((keys[i] & unseenBit) != 0u) command.instanceCount = 0u;
    seen[i] = command;
    return;
  }
  DrawPlace place = places[i];
  bool isSeen = false;
  for (int v = 0; v < kViewCount; ++v) isSeen = isSeen || mayBeSeen(place, frame.views[v].worldToClip);
  uint distance = distanceKey(0.5 * (place.low + place.high)) >> (33u - cull.bucketShift);
  keys[i] = place.bucket << cull.bucketShift | (isSeen ? 0u : unseenBit) | distance;
  order[i] = i;
}
