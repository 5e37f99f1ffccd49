#version 460
// The ocean alone: what its painting needs to know of the nearest water at each pixel.
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/frame.glsl"
#include "../../../shading/metatexture.glsl"
#include "../ocean.shared.h"
#include "../../../shading/surface_tangents.glsl"
#include "../../../shading/view_index.glsl"

layout(constant_id = kPassId) const int kTangents = 0;  // options of surface_tangents.shared.h
layout(set = 2, binding = 0, scalar) readonly buffer Waves { OceanField field; OceanPoint points[]; };
#include "../water.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec2 inNormal;
layout(location = 5) in vec3 inDPdu;
layout(location = 7) in vec3 inDPdv;
layout(location = 8) in vec2 inPatternUv;

layout(location = 0) out vec2 outPatternUv;
layout(location = 1) out vec3 outTangentU;
layout(location = 2) out vec3 outTangentV;
layout(location = 3) out vec3 outPoint;
layout(location = 4) out vec4 outWave;       // height in reliefs, Jacobian, x and z of the normal
layout(location = 5) out vec2 outDecorated;  // cover of foam, how far strokes are suppressed

void main() {
  mat4 worldToClip = VIEW_FIELD(worldToClip, viewIndex());
  gl_Position = worldToClip * vec4(inPosition, 1.0);
  ObjectData object = objects[gl_InstanceIndex];
  outPatternUv = inPatternUv + object.patternShift;
  mat4 tangentClip = tangentView(kTangents, worldToClip);
  outTangentU = tangentToClip(tangentClip, inDPdu);
  outTangentV = tangentToClip(tangentClip, inDPdv);
  outPoint = pointInTangentView(kTangents, worldToClip, inPosition);

  vec2 fromMiddle = inPatternUv * kWaterPerPattern;
  vec2 place = fromMiddle - (object.kind == kWaves ? field.within : vec2(0.0));
  OceanPoint point;
  if (object.kind == kDecoration)
    point = wavesAt(place);
  else  // the grid's point that the vertex is, which has slid under the mesh
    point = oceanPoint(ivec2(round(fromMiddle / field.cell)) + field.travelled);
  float whole = object.kind == kFlat ? 0.0 : wavesWhole(length(place));
  outWave = vec4(whole * point.displacement.y / field.relief,
                 mix(1.0, point.jacobian, whole), decodeNormal(inNormal).xz);
  outDecorated = vec2(0.0);
  if (field.decorationCount + field.zoneCount > 0) {
    Decorated here = decoratedAt(place);
    // Without strokes, colours that go over by the waves' height would be an airbrush's.
    outWave.x = (1.0 - here.calm) * outWave.x + here.crest;
    outDecorated = vec2(here.cover, here.calm);
  }
}
