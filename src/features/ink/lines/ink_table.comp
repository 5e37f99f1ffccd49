#version 460
// Lines of a view as a table for the CPU (ink.shared.h).
#extension GL_GOOGLE_include_directive : require
#include "ink_record.glsl"

layout(local_size_x = kInkThreads) in;
layout(set = 1, binding = kInkCommand, scalar) readonly buffer Command { InkCommand command; };
layout(set = 2, binding = kLineTableImage, rgba32f) writeonly uniform image2DArray table;

void main() {
  int line = int(gl_GlobalInvocationID.x), view = int(gl_WorkGroupID.z);
  uint count = command.vertexCount / 6u;
  ivec3 place = ivec3(uint(line) % uint(kLineTableWidth), line / kLineTableWidth * kLineTexels, view);
  if (line == 0) {
    ivec3 header = ivec3(0, kLineTableRows * kLineTexels, view);
    float parallel = VIEW_FIELD(orthographic, view);
    imageStore(table, header, vec4(float(count), frame.pixelScale, frame.sceneRadius, parallel));
    imageStore(table, header + ivec3(1, 0, 0), vec4(metresOfPixel(1.0, view), ink.fade, ink.outer, ink.overlap));
    imageStore(table, header + ivec3(2, 0, 0),
               vec4(ink.offset, kDoubled ? ink.doubled : 0.0, ink.doubledWidth, float(kPlacement)));
  }
  ivec3 down = ivec3(0, 1, 0);
  if (uint(line) >= count) return;
  LineRecord record = recordOf(numbers[line], view, true);
  vec2 metres = vec2(eyeDepth(record.radii.z, view), eyeDepth(record.radii.w, view));
  imageStore(table, place, record.spine);
  imageStore(table, place + down, record.shift);
  imageStore(table, place + 2 * down, vec4(record.radii.xy, metres));
  imageStore(table, place + 3 * down, record.color);
  imageStore(table, place + 4 * down, vec4(record.outward, float(1 + record.kind)));
  imageStore(table, place + 5 * down, vec4(record.turn, record.reach));
  imageStore(table, place + 6 * down, vec4(float(record.seen & 0xFFFFu), float(record.seen >> 16u), 0.0, 0.0));
  imageStore(table, place + 7 * down, record.slopes);
}
