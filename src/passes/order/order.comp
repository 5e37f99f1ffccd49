#version 460
// Before the sort: each triangle's key, the less the farther its middle lies from the middle of all eyes. After it
// (kGathers): vertices in the order of the keys.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/distance_key.glsl"
#include "../../shading/paint_fade.glsl"
#include "../../shading/transparent.shared.h"
#include "order.shared.h"

layout(constant_id = kPassId) const bool kGathers = false;

layout(local_size_x = kOrderThreads) in;
layout(set = 1, binding = 0, scalar) readonly buffer Triangles { TransparentTriangle triangles[]; };
layout(set = 1, binding = 1, scalar) readonly buffer Parts { TransparentPart parts[]; };
layout(set = 1, binding = 2, scalar) readonly buffer Vertices { VertexCore vertices[]; };
layout(set = 1, binding = 3, scalar) buffer Keys { uint keys[]; };
layout(set = 1, binding = 4, scalar) buffer Order { uint order[]; };
layout(set = 1, binding = 5, scalar) writeonly buffer Indices { uvec3 indices[]; };
layout(push_constant, scalar) uniform Push { uint count; };

// 24 bits tell distances apart by 15 millionths, and sort faster than 32 do.
const uint kUnseen = 0xFFFFFFu;  // comes last

void main() {
  uint i = (gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x) * kOrderThreads + gl_LocalInvocationID.x;
  if (i >= count) return;
  if (kGathers) {
    indices[i] = keys[i] != kUnseen ? triangles[order[i]].vertices : uvec3(0);
    return;
  }
  TransparentTriangle triangle = triangles[i];
  TransparentPart part = parts[triangle.part];
  vec3 positions[3], normals[3];
  for (int c = 0; c < 3; ++c) {
    VertexCore vertex = vertices[triangle.vertices[c]];
    positions[c] = vertex.position;
    normals[c] = decodeNormal(unpackSnorm2x16(vertex.normal));
  }
  bool isSeen = part.visible != 0 && !(part.fadeStart > 0.0 && isFadedAway(part.fadeStart, positions, normals)) &&
                !(part.isCoat != 0 && isTurnedAway(positions, (part.known & 1u) != 0));
  uint key = ~distanceKey((positions[0] + positions[1] + positions[2]) / 3.0) >> 8;
  keys[i] = isSeen ? min(key, kUnseen - 1u) : kUnseen;
  order[i] = i;
}
