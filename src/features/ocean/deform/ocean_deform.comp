#version 460
// Final vertices of water that moves: the ocean's mesh lifted by waves, decorations on it, and meshes of the scene that
// lie on it.
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/deform.glsl"
#include "../ocean.shared.h"

// Which objects: kWaves, kDecoration or kDraped. In one shader each would pay for the other, since CPU drivers execute both sides
// of an `if`.
layout(constant_id = 1) const uint kWater = 0;

layout(set = 2, binding = 0, scalar) readonly buffer Waves { OceanField field; OceanPoint points[]; };
#include "../water.glsl"

void main() {
  uint group = movedIndex();
  if (group >= movedCount) return;
  DeformChunk chunk = chunks[moved[firstMoved + group]];
  ObjectData object = placed[chunk.object];
  uint count = kWater == object.kind ? chunk.count : 0;
  for (uint i = gl_LocalInvocationID.x; i < count; i += kDeformThreads) {
    VertexCore core = restCore[chunk.restVertex + i];
    VertexFrame around = restFrame[chunk.restVertex + i];
    vec3 normal, smoothNormal;
    mat4 toWorld = object.model;
    vec3 rest = core.position;
    core.position = (toWorld * vec4(core.position, 1.0)).xyz;
    if (kWater == kWaves) {
      // Waves fade into flat water before the mesh ends, and dip below it.
      OceanPoint point = oceanPoint(field.first + ivec2(round(rest.xz / field.cell)));
      vec2 place = core.position.xz - field.origin.xz;
      float whole = wavesWhole(length(place));
      core.position += whole * point.displacement;
      core.position.y -= (1.0 - whole) * field.sink;
      core.position.y -= takenDown(core.position - field.origin);
      if (field.decorationCount + field.zoneCount > 0) core.position.y -= pushedDown(decoratedAt(place));
      normal = smoothNormal = normalize(mix(vec3(0.0, 1.0, 0.0), point.normal, whole));
      vec2 slopes = -normal.xz / max(normal.y, 0.2);
      around.dPdu.y = around.dPdu.x * slopes.x;
      around.dPdv.y = around.dPdv.z * slopes.y;
    }
    if (kWater == kDecoration) {
      // On the ocean's mesh as it would be without it, and what it adds to that.
      vec2 place = decorationPlace(int(object.detail), rest.xy);
      float whole = wavesWhole(length(place));
      OceanPoint point = wavesAt(place);
      Decorated here = decoratedAt(place);
      vec3 surface = vec3(place.x, 0.0, place.y) + whole * point.displacement;
      surface.y -= (1.0 - whole) * field.sink;
      surface.y -= takenDown(surface);
      core.position = field.origin + surface + here.displacement;
      const float kStep = 0.03;  // metres
      vec3 alongX = vec3(kStep, 0.0, 0.0) + decoratedAt(place + vec2(kStep, 0.0)).displacement - here.displacement;
      vec3 alongZ = vec3(0.0, 0.0, kStep) + decoratedAt(place + vec2(0.0, kStep)).displacement - here.displacement;
      vec3 own = normalize(cross(alongZ, alongX)), wave = mix(vec3(0.0, 1.0, 0.0), point.normal, whole);
      // Slopes add up.
      normal = smoothNormal = normalize(vec3(own.xz * wave.y + wave.xz * own.y, own.y * wave.y).xzy);
      vec2 slopes = -normal.xz / max(normal.y, 0.2);
      around.dPdu = vec3(kWaterPerPattern, kWaterPerPattern * slopes.x, 0.0);
      around.dPdv = vec3(0.0, kWaterPerPattern * slopes.y, kWaterPerPattern);
      if (!kPositionsOnly) patternUvs[chunk.finalVertex + i] = place / kWaterPerPattern;
    }
    if (kWater == kDraped) {
      // Its place without features, sheared up and down with the waves beneath it.
      PosedVertex v = posedVertex(chunk, object, i);
      if (object.influences > 0) v.position = (object.model * vec4(v.position, 1.0)).xyz;
      vec2 place = v.position.xz - field.origin.xz;
      float whole = wavesWhole(length(place));
      OceanPoint point = wavesAt(place);
      float sinks = (1.0 - whole) * field.sink;
      vec3 surface = vec3(place.x, -sinks, place.y) + whole * point.displacement;
      v.position += whole * point.displacement;
      v.position.y += kDrapedLift - sinks - takenDown(surface);
      vec3 wave = mix(vec3(0.0, 1.0, 0.0), point.normal, whole);
      vec2 slopes = -wave.xz / max(wave.y, 0.2);
      v.normal = normalize(v.normal);
      v.normal.xz -= slopes * v.normal.y;
      v.smoothNormal = normalize(v.smoothNormal);
      v.smoothNormal.xz -= slopes * v.smoothNormal.y;
      v.dPdu.y += dot(v.dPdu.xz, slopes);
      v.dPdv.y += dot(v.dPdv.xz, slopes);
      writeVertex(chunk, i, v);
      continue;
    }
    if (kPositionsOnly) {
      previousPosition[chunk.finalVertex + i] = core.position;
      continue;
    }
    core.normal = encodeNormal(object.normal * normal);
    around.dPdu = mat3(toWorld) * around.dPdu;
    around.dPdv = mat3(toWorld) * around.dPdv;
    around.smoothNormal = encodeNormal(object.normal * smoothNormal);
    finalCore[chunk.finalVertex + i] = core;
    finalFrame[chunk.finalVertex + i] = around;
  }
}
