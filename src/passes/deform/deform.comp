#version 460
// Deform once, draw many: final world-space vertices of everything that has moved, once a frame. Every other pass
// draws from them. A second time, with kPositionsOnly, for where they were a frame ago.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/deform.glsl"

void main() {
  uint group = movedIndex();
  if (group >= movedCount) return;
  DeformChunk chunk = chunks[moved[firstMoved + group]];
  ObjectData object = placed[chunk.object];
  for (uint i = gl_LocalInvocationID.x; i < chunk.count; i += kDeformThreads) {
    VertexCore core = restCore[chunk.restVertex + i];
    VertexFrame around = restFrame[chunk.restVertex + i];
    vec3 normal = decodeNormal(unpackSnorm2x16(core.normal));
    vec3 smoothNormal = decodeNormal(unpackSnorm2x16(around.smoothNormal));

    // Morph targets, in the object's own space.
    if (chunk.morphVertex != kNoMorph)
      for (uint k = morphStarts[chunk.morphVertex + i]; k < morphStarts[chunk.morphVertex + i + 1]; ++k) {
        MorphDisplacement d = morphs[k];
        float weight = morphWeights[object.firstMorphWeight + d.target];
        core.position += weight * d.position;
        normal += weight * d.normal;
        smoothNormal += weight * d.smoothNormal;
        around.dPdu += weight * d.dPdu;
        around.dPdv += weight * d.dPdv;
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

    core.position = (toWorld * vec4(core.position, 1.0)).xyz;
    if (kPositionsOnly) {
      previousPosition[chunk.finalVertex + i] = core.position;
      continue;
    }
    core.normal = encodeNormal(normalToWorld * normal);
    around.dPdu = mat3(toWorld) * around.dPdu;
    around.dPdv = mat3(toWorld) * around.dPdv;
    around.smoothNormal = encodeNormal(normalToWorld * smoothNormal);
    finalCore[chunk.finalVertex + i] = core;
    finalFrame[chunk.finalVertex + i] = around;
  }
}
