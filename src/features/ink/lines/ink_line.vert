#version 460
// A line of an edge: a quad around it, with room for its round ends, which close the joints between lines.
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/view_index.glsl"
#include "../fullness.shared.h"
#include "ink_record.glsl"

layout(set = 1, binding = kInkRecords, scalar) readonly buffer Records { LineRecord records[]; };

layout(location = 0) flat out vec4 outSpine;    // as LineRecord has them
layout(location = 1) flat out vec4 outShift;
layout(location = 2) flat out vec4 outRadii;
layout(location = 3) flat out vec4 outColor;
layout(location = 4) flat out vec3 outOutward;
layout(location = 5) flat out vec4 outTurn;  // and reach
// For lines with a texture, gaps or dashes: both ends, and how far a pixel across and down leads at a metre's distance, in the object's space at rest.
layout(location = 6) flat out vec3 outRestA;
layout(location = 7) flat out vec3 outRestB;
layout(location = 8) flat out vec3 outAcross;
layout(location = 9) flat out vec3 outDown;
layout(location = 10) flat out uint outSeen;
layout(location = 11) flat out vec4 outSlopes;
layout(location = 12) flat out uint outTurned;  // 1: its surface is seen from behind alone, where it is not drawn

void findRest(uint number, int view, out vec3 a, out vec3 b, out vec3 across, out vec3 down) {
  EdgeChunk chunk = chunks[number / uint(kEdgeChunk)];
  DrawnEdge edge = edgeOf(chunk.firstEdge + number % uint(kEdgeChunk));
  uint first = chunk.firstVertex + (edge.a & kEdgeVertexMask), second = chunk.firstVertex + edge.b;
  Vertices atRest = Vertices(ink.addresses.rest);
  a = atRest.at[first + chunk.restShift].position;
  b = atRest.at[second + chunk.restShift].position;
  // How much longer the edge is in the world: what is far away or small has the same marks. A bent form is turned as if it
  // were not.
  float longer = distance(positionOf(first), positionOf(second)) / max(distance(a, b), 1e-20);
  ObjectData object = objects[chunk.object];
  mat3 turn = object.influences == 0u ? mat3(object.model) : mat3(1.0);
  for (int i = 0; i < 3; ++i) turn[i] *= inversesqrt(max(dot(turn[i], turn[i]), 1e-37));
  mat4 toEye = VIEW_FIELD(worldToEye, view);
  vec3 right = vec3(toEye[0][0], toEye[1][0], toEye[2][0]), up = vec3(toEye[0][1], toEye[1][1], toEye[2][1]);
  float step = metresOfPixel(1.0, view) / max(longer, 1e-20);
  across = step * (right * turn);
  down = -step * (up * turn);
}

void main() {
  int line = gl_VertexIndex / 6, corner = int(uint(gl_VertexIndex) % 6u), view = viewIndex();
  LineRecord record;
  if (line < kInkRoom)
    record = records[view * kInkRoom + line];
  else
    record = recordOf(numbers[line], view, false);
  outSpine = record.spine, outShift = record.shift, outRadii = record.radii, outColor = record.color;
  outOutward = record.outward, outTurn = vec4(record.turn, record.reach);
  outSeen = record.seen, outSlopes = record.slopes;
  outTurned = uint(record.kind & kInkTurned) / uint(kInkTurned);
  gl_Position = vec4(2.0, 2.0, 0.0, 1.0);  // outside
  if (record.kind == kInkNone) return;

  outRestA = outRestB = outAcross = outDown = vec3(0.0);
  if (kTexture != kInkPlain || kBreaks || kHidden) findRest(numbers[line], view, outRestA, outRestB, outAcross, outDown);

  vec2 direction = record.spine.zw - record.spine.xy;
  float size = length(direction);
  direction = size > 1e-6 ? direction / size : vec2(1.0, 0.0);
  vec2 across = record.outward.xy;
  bool isOutline = record.outward.z > 0.0;
  // The quad, no larger than it must be: of whatever moves beside the edge, what lies along it is its caps'.
  vec2 radii = record.radii.xy;
  if (isOutline) radii *= max(ink.outer, 1.0);
  float radius = max(max(radii.x, radii.y), 0.5), moved = 0.0, inside = radius + 1.0;
  if (isOutline) {
    moved = abs(ink.offset) * frame.pixelScale;
    if (kPlacement == kInkExterior) {
      moved += max(radius - ink.overlap, 0.0);
      inside = max(ink.overlap, 0.5) + 1.0;
    }
  }
  float reach = radius + moved + 1.0;
  inside = mix(inside, reach, float(ink.offset < 0.0));
  if (isOutline && kDoubled) {
    float second = abs(ink.doubled) * frame.pixelScale + radius * max(ink.doubledWidth, 1.0);
    reach += second;
    inside = max(inside, mix(radius * ink.doubledWidth + 1.0, reach, float(ink.doubled < 0.0)));
  }
  bool isEnd = corner == 1 || corner == 2 || corner == 4, isUp = corner == 2 || corner == 4 || corner == 5;
  float beyond = (isEnd ? record.caps.y : record.caps.x) * (reach - 1.0) + 1.0;
  vec2 place = (isEnd ? record.spine.zw + direction * beyond : record.spine.xy - direction * beyond) +
               across * (isUp ? reach : -inside);
  gl_Position = vec4(place / (0.5 * frame.imageSize) - 1.0, 0.5, 1.0);
}
