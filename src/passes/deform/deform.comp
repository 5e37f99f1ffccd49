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
  for (uint i = gl_LocalInvocationID.x; i < chunk.count; i += kDeformThreads)
    writeVertex(chunk, i, posedVertex(chunk, object, i));
}
