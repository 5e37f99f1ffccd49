#version 460
// Deform once, draw many: final world-space vertices of everything that has moved, once a frame. Every other pass
// draws from them. A second time, with kPositionsOnly, for where they were a frame ago.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "../../shading/ocean.shared.h"
#include "deform.shared.h"

layout(constant_id = 0) const bool kPositionsOnly = false;
// 0: for what is no water; kWaves: for all but its decorations; kDecoration: for these alone. In one shader each would pay
// for the others, since CPU drivers execute both sides of an `if`.
layout(constant_id = 1) const uint kWater = 0;

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

// Of an ocean, else anything.
layout(set = 1, binding = 13, scalar) readonly buffer Waves { OceanField field; OceanPoint points[]; };
layout(set = 1, binding = 14, scalar) writeonly buffer Surface { VertexSurface surface[]; };
#include "../../shading/water.glsl"

layout(push_constant, scalar) uniform Push { uint firstMoved, movedCount; };

void main() {
  uint group = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (group >= movedCount) return;
  DeformChunk chunk = chunks[moved[firstMoved + group]];
  ObjectData object = placed[chunk.object];
  uint count = kWater != 0 && (kWater == kDecoration) != (object.water == kDecoration) ? 0 : chunk.count;
  for (uint i = gl_LocalInvocationID.x; i < count; i += kDeformThreads) {
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

    vec3 rest = core.position;
    core.position = (toWorld * vec4(core.position, 1.0)).xyz;
    if (kWater == kWaves && object.water == kWaves) {
      // Waves fade into flat water before the mesh ends, and dip below it.
      OceanPoint point = oceanPoint(field.first + ivec2(round(rest.xz / field.cell)));
      vec2 place = core.position.xz - field.origin.xz;
      float whole = wavesWhole(length(place));
      core.position += whole * point.displacement;
      core.position.y -= (1.0 - whole) * field.sink;
      if (field.decorationCount > 0) core.position.y -= pushedDown(decoratedAt(place).outside);
      normal = smoothNormal = normalize(mix(vec3(0.0, 1.0, 0.0), point.normal, whole));
      vec2 slopes = -normal.xz / max(normal.y, 0.2);
      around.dPdu.y = around.dPdu.x * slopes.x;
      around.dPdv.y = around.dPdv.z * slopes.y;
    }
    if (kWater == kDecoration) {
      // On the ocean's mesh as it would be without it, and what it adds to that.
      vec2 place = decorationPlace(int(object.decoration), rest.xy);
      float whole = wavesWhole(length(place));
      OceanPoint point = wavesAt(place);
      Decorated here = decoratedAt(place);
      core.position = field.origin + vec3(place.x, 0.0, place.y) + whole * point.displacement + here.displacement;
      core.position.y -= (1.0 - whole) * field.sink;
      const float kStep = 0.03;  // metres
      vec3 alongX = vec3(kStep, 0.0, 0.0) + decoratedAt(place + vec2(kStep, 0.0)).displacement - here.displacement;
      vec3 alongZ = vec3(0.0, 0.0, kStep) + decoratedAt(place + vec2(0.0, kStep)).displacement - here.displacement;
      vec3 own = normalize(cross(alongZ, alongX)), wave = mix(vec3(0.0, 1.0, 0.0), point.normal, whole);
      // Slopes add up.
      normal = smoothNormal = normalize(vec3(own.xz * wave.y + wave.xz * own.y, own.y * wave.y).xzy);
      vec2 slopes = -normal.xz / max(normal.y, 0.2);
      around.dPdu = vec3(kWaterPerPattern, kWaterPerPattern * slopes.x, 0.0);
      around.dPdv = vec3(0.0, kWaterPerPattern * slopes.y, kWaterPerPattern);
      if (!kPositionsOnly) surface[chunk.finalVertex + i].patternUv = place / kWaterPerPattern;
    }
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
