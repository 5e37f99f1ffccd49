// The edges of what is drawn (lines/edges_on_gpu.h).
#ifndef SCUMBLE_EDGES_SHARED_H
#define SCUMBLE_EDGES_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN

// Final vertices, counted from where the chunk's begin. An edge goes from a to b along its left triangle.
// Where b is a there is none.
struct DrawnEdge {
  uint a;  // the upper four bits: what it is besides, kEdgeMaterialBorder ...
  uint b;
  uint left;   // the left triangle's third vertex
  uint right;  // the right one's; kNoEdgeSide: the surface ends here
};
// Third vertices of the triangles beyond the left one (across b to left, and left to a), and beyond the right
// one (across a to right, and right to b). kNoEdgeSide: there is none.
struct EdgeRing {
  uint beyondLeft[2];
  uint beyondRight[2];
  // At a and b: factors on the width of the material's own outline; how round the form is, where that is
  // known (kEdgeRoundnessKnown). As unorm4x8.
  uint ends;
  uint seen;  // by part of the edge, of 32 from a on: 1 where a surface beside it is not cut away
};
const uint kNoEdgeSide = 0xFFFFFFFFu;
const uint kEdgeVertexMask = 0x0FFFFFFFu;
const uint kEdgeMaterialBorder = 0x10000000u, kEdgeColorBorder = 0x20000000u,
           kEdgeRoundnessKnown = 0x40000000u;

// A run of edges of one object. A number of an edge among all that are drawn is that of its chunk times
// kEdgeChunk, and its place in it.
const int kEdgeChunk = 1024;
struct EdgeChunk {
  uint firstEdge, count;
  uint firstVertex;  // of the final ones
  uint object;
  uint firstBounds;  // of its words of edges (edge_bounds.shared.h); kNoEdgeBounds: it may bend
  uint restShift;    // added to the number of an edge's end among all final vertices: among those at rest
};
const uint kNoEdgeBounds = 0xFFFFFFFFu;

SHARED_END
#endif
