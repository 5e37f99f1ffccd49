#version 460
// A line of an edge: a quad around it, with room for its round ends, which close the joints between lines.
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/view_index.glsl"
#include "ink_record.glsl"

layout(set = 1, binding = kInkRecords, scalar) readonly buffer Records { LineRecord records[]; };

layout(location = 0) flat out vec4 outSpine;    // as LineRecord has them
layout(location = 1) flat out vec4 outShift;
layout(location = 2) flat out vec4 outRadii;
layout(location = 3) flat out vec4 outColor;
layout(location = 4) flat out vec3 outOutward;
layout(location = 5) flat out vec2 outTurn;

void main() {
  int line = gl_VertexIndex / 6, corner = gl_VertexIndex % 6, view = viewIndex();
  LineRecord record;
  if (line < kInkRoom)
    record = records[view * kInkRoom + line];
  else
    record = recordOf(numbers[line], view);
  outSpine = record.spine, outShift = record.shift, outRadii = record.radii, outColor = record.color;
  outOutward = record.outward, outTurn = record.turn;
  gl_Position = vec4(2.0, 2.0, 0.0, 1.0);  // outside
  if (record.kind == kInkNone) return;

  vec2 direction = record.spine.zw - record.spine.xy;
  float size = length(direction);
  direction = size > 1e-6 ? direction / size : vec2(1.0, 0.0);
  vec2 across = record.outward.xy;
  bool isOutline = record.outward.z > 0.0;
  // The quad, no larger than it must be.
  vec2 radii = record.radii.xy;
  if (isOutline) radii *= max(ink.outer, 1.0);
  float radius = max(max(radii.x, radii.y), 0.5), moved = 0.0, inside = radius + 1.0;
  if (isOutline) {
    bool isExterior = kPlacement == kInkExterior;
    moved = abs(ink.offset) * frame.pixelScale + (isExterior ? radius : 0.0);
    if (isExterior) inside = 1.75 + 2.4 * frame.pixelScale;  // what it overlaps, and anti-aliasing
  }
  float reach = radius + moved / 0.7 + 1.0;
  inside = mix(inside, reach, float(ink.offset < 0.0));
  if (isOutline && kDoubled) {
    float second = abs(ink.doubled) * frame.pixelScale / 0.7 + radius * max(ink.doubledWidth, 1.0);
    reach += second;
    inside = mix(inside, max(inside, reach), float(ink.doubled < 0.0));
  }
  bool isEnd = corner == 1 || corner == 2 || corner == 4, isUp = corner == 2 || corner == 4 || corner == 5;
  float beyond = (isEnd ? record.caps.y : record.caps.x) * (reach - 1.0) + 1.0;
  vec2 place = (isEnd ? record.spine.zw + direction * beyond : record.spine.xy - direction * beyond) +
               across * (isUp ? reach : -inside);
  gl_Position = vec4(place / (0.5 * frame.imageSize) - 1.0, 0.5, 1.0);
}
