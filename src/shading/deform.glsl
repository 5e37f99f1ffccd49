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

// The workgroup's number among the moved chunks; there may be a few too many.
uint movedIndex() {
  return gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
}
#endif
