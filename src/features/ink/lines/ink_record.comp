#version 460
// How lines look, in each view, once.
#extension GL_GOOGLE_include_directive : require
#include "ink_record.glsl"

layout(local_size_x = kInkThreads) in;
layout(set = 1, binding = kInkRecords, scalar) writeonly buffer Records { LineRecord records[]; };
layout(set = 1, binding = kInkCommand, scalar) readonly buffer Command { InkCommand command; };

void main() {
  uint line = gl_GlobalInvocationID.x;
  if (line >= min(command.vertexCount / 6u, uint(kInkRoom))) return;
  for (int view = 0; view < kViewCount; ++view) records[view * kInkRoom + int(line)] = recordOf(numbers[line], view, false);
}
