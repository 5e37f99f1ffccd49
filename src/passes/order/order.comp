#version 460
// Before the sort: each triangle's key, the less the farther its middle lies from the middle of all eyes. After it
// (kGathers): vertices in the order of the keys.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/distance_key.glsl"
#include "../../shading/transparent.shared.h"
#include "order.shared.h"

layout(constant_id = 0) const bool kGathers = false;

layout(local_size_x = kOrderThreads) in;
layout(set = 1, binding = 0, scalar) readonly buffer Triangles { TransparentTriangle triangles[]; };
layout(set = 1, binding = 1, scalar) readonly buffer Parts { TransparentPart parts[]; };
layout(set = 1, binding = 2, scalar) readonly buffer Vertices { VertexCore vertices[]; };
layout(set = 1, binding = 3, scalar) writeonly buffer Keys { uint keys[]; };
layout(set = 1, binding = 4, scalar) buffer Order { uint order[]; };
layout(set = 1, binding = 5, scalar) writeonly buffer Indices { uvec3 indices[]; };
layout(push_constant, scalar) uniform Push { uint count; };

void main() {
  uint i = (gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x) * kOrderThreads + gl_LocalInvocationID.x;
  if (i >= count) return;
  if (kGathers) {
    TransparentTriangle triangle = triangles[order[i]];
    indices[i] = parts[triangle.part].visible != 0 ? triangle.vertices : uvec3(0);
    return;
  }
  TransparentTriangle triangle = triangles[i];
  vec3 middle = (vertices[triangle.vertices.x].position + vertices[triangle.vertices.y].position +
                   vertices[triangle.vertices.z].position) / 3.0;
  keys[i] = parts[triangle.part].visible != 0 ? ~distanceKey(middle) : 0xFFFFFFFFu;
  order[i] = i;
}
