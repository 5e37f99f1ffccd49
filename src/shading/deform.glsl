// What writes final vertices reads: a workgroup has a chunk of vertices of one object that has moved (set 1 of a
// DeformStep). Set 2 is the shader's own.
#ifndef SCUMBLE_DEFORM_GLSL
#define SCUMBLE_DEFORM_GLSL
#include "frame.glsl"
#include "deform.shared.h"

layout(constant_id = 0) const bool kPositionsOnly = false;  // for where they were a frame ago

layout(local_size_x = kDeformThreads) in;

layout(set = 1, binding = 0, scalar) readonly buffer ChunkBlock { DeformChunk chunks[]; };
layout(set = 1, binding = 1, scalar) readonly buffer MovedBlock { uint moved[]; };
layout(set = 1, binding = 2, scalar) readonly buffer PlacedObjects { ObjectData placed[]; };
layout(set = 1, binding = 3, scalar) readonly buffer Joints { mat4 jointMatrices[]; };
layout(set = 1, binding = 4, scalar) readonly buffer MorphWeights { float morphWeights[]; };
layout(set = 1, binding = 5, scalar) readonly buffer RestCore { VertexCore restCore[]; };
layout(set = 1, binding = 6, scalar) readonly buffer RestFrame { VertexFrame restFrame[]; };
layout(set = 1, binding = 7, scalar) readonly buffer RestSkin { VertexSkin restSkin[]; };
layout(set = 1, binding = 8, scalar) readonly buffer MorphStarts { uint morphStarts[]; };
layout(set = 1, binding = 9, scalar) readonly buffer Morphs { MorphDisplacement morphs[]; };
layout(set = 1, binding = 10, scalar) writeonly buffer FinalCore { VertexCore finalCore[]; };
layout(set = 1, binding = 11, scalar) writeonly buffer FinalFrame { VertexFrame finalFrame[]; };
layout(set = 1, binding = 12, scalar) writeonly buffer PreviousPosition { vec3 previousPosition[]; };
layout(set = 1, binding = 13, scalar) writeonly buffer PatternUvs { vec2 patternUvs[]; };

layout(push_constant, scalar) uniform Push { uint firstMoved, movedCount; };

// A vertex in the world, after morph targets and joints; normals of any length.
struct PosedVertex {
  vec3 position, normal, smoothNormal, dPdu, dPdv;
};
PosedVertex posedVertex(DeformChunk chunk, ObjectData object, uint i) {
  PosedVertex v;
  VertexCore core = restCore[chunk.restVertex + i];
  VertexFrame around = restFrame[chunk.restVertex + i];
  v.position = core.position;
  v.normal = decodeNormal(unpackSnorm2x16(core.normal));
  v.smoothNormal = decodeNormal(unpackSnorm2x16(around.smoothNormal));
  v.dPdu = around.dPdu;
  v.dPdv = around.dPdv;

  // Morph targets, in the object's own space.
  if (chunk.morphVertex != kNoMorph)
    for (uint k = morphStarts[chunk.morphVertex + i]; k < morphStarts[chunk.morphVertex + i + 1]; ++k) {
      MorphDisplacement d = morphs[k];
      float weight = morphWeights[object.firstMorphWeight + d.target];
      v.position += weight * d.position;
      v.normal += weight * d.normal;
      v.smoothNormal += weight * d.smoothNormal;
      v.dPdu += weight * d.dPdu;
      v.dPdv += weight * d.dPdv;
    }

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
  v.position = (toWorld * vec4(v.position, 1.0)).xyz;
  v.normal = normalToWorld * v.normal;
  v.smoothNormal = normalToWorld * v.smoothNormal;
  v.dPdu = mat3(toWorld) * v.dPdu;
  v.dPdv = mat3(toWorld) * v.dPdv;
  return v;
}

// Writes it, or where it was a frame ago, its place alone.
void writeVertex(DeformChunk chunk, uint i, PosedVertex v) {
  uint at = chunk.finalVertex + i;
  if (kPositionsOnly) {
    previousPosition[at] = v.position;
    return;
  }
  VertexCore core = restCore[chunk.restVertex + i];
  VertexFrame around = restFrame[chunk.restVertex + i];
  core.position = v.position;
  core.normal = encodeNormal(v.normal);
  around.smoothNormal = encodeNormal(v.smoothNormal);
  around.dPdu = v.dPdu;
  around.dPdv = v.dPdv;
  finalCore[at] = core;
  finalFrame[at] = around;
}

// The workgroup's number among the moved chunks; there may be a few too many.
uint movedIndex() {
  return gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
}
#endif
