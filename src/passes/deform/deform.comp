#version 460
// Deform once, draw many: final world-space vertices of everything, once a frame. Every other pass draws from them.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "deform.shared.h"

layout(local_size_x = kDeformThreads) in;

layout(set = 1, binding = 0, scalar) readonly buffer ChunkBlock { DeformChunk chunks[]; };
layout(set = 1, binding = 1, scalar) readonly buffer RestCore { VertexCore restCore[]; };
layout(set = 1, binding = 2, scalar) readonly buffer RestFrame { VertexFrame restFrame[]; };
layout(set = 1, binding = 3, scalar) readonly buffer RestSkin { VertexSkin restSkin[]; };
layout(set = 1, binding = 4, scalar) readonly buffer Joints { mat4 jointMatrices[]; };
layout(set = 1, binding = 5, scalar) writeonly buffer FinalCore { VertexCore finalCore[]; };
layout(set = 1, binding = 6, scalar) writeonly buffer FinalFrame { VertexFrame finalFrame[]; };

void main() {
  DeformChunk chunk = chunks[gl_WorkGroupID.x + gl_WorkGroupID.y * kMaxGroupsX];
  ObjectData object = objects[chunk.object];
  for (uint i = gl_LocalInvocationID.x; i < chunk.count; i += kDeformThreads) {
    VertexCore core = restCore[chunk.restVertex + i];
    VertexFrame around = restFrame[chunk.restVertex + i];

    // From the rest pose to the world: the object's matrix, or the blend of its joints' (linear blend skinning).
    mat4 toWorld = object.model;
    mat3 normalToWorld = object.normal;
    if (object.influences > 0) {
      toWorld = mat4(0.0);
      for (uint k = 0; k < object.influences / 4; ++k) {
        VertexSkin skin = restSkin[chunk.skinVertex + i * (object.influences / 4) + k];
        toWorld += jointMatrices[object.firstJoint + (skin.joints.x & 0xFFFFu)] * skin.weights.x;
        toWorld += jointMatrices[object.firstJoint + (skin.joints.x >> 16)] * skin.weights.y;
        toWorld += jointMatrices[object.firstJoint + (skin.joints.y & 0xFFFFu)] * skin.weights.z;
        toWorld += jointMatrices[object.firstJoint + (skin.joints.y >> 16)] * skin.weights.w;
      }
      // The cofactor matrix turns normals right under any linear map, mirrored ones included.
      mat3 m = mat3(toWorld);
      normalToWorld = mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
      if (dot(m[0], normalToWorld[0]) < 0.0) normalToWorld = -normalToWorld;
    }

    core.position = (toWorld * vec4(core.position, 1.0)).xyz;
    core.normal = encodeNormal(normalToWorld * decodeNormal(unpackSnorm2x16(core.normal)));
    around.dPdu = mat3(toWorld) * around.dPdu;
    around.dPdv = mat3(toWorld) * around.dPdv;
    around.smoothNormal = encodeNormal(normalToWorld * decodeNormal(unpackSnorm2x16(around.smoothNormal)));
    finalCore[chunk.finalVertex + i] = core;
    finalFrame[chunk.finalVertex + i] = around;
  }
}
