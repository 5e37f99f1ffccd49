// An edge as it is drawn, and what kind of line it is.
#ifndef SCUMBLE_INK_EDGE_GLSL
#define SCUMBLE_INK_EDGE_GLSL
#include "../../shading/frame.glsl"
#include "ink.shared.h"

layout(set = 1, binding = kInkBlock, scalar) uniform Ink { InkUniforms ink; };
layout(set = 1, binding = kInkEdges, scalar) readonly buffer Edges { DrawnEdge edges[]; };
layout(set = 1, binding = kInkChunks, scalar) readonly buffer Chunks { EdgeChunk chunks[]; };
layout(set = 1, binding = kInkVertices, scalar) readonly buffer Vertices { VertexCore vertices[]; };

struct PlacedEdge {
  vec3 a, b;             // world
  vec3 left, right;      // normals of the triangles, as long as twice their area; as they are wound
  uint known;            // kEdgeMaterialBorder ...
  bool isOpen;
};

PlacedEdge placed(DrawnEdge edge, uint first) {
  PlacedEdge result;
  result.a = vertices[first + (edge.a & kEdgeVertexMask)].position;
  result.b = vertices[first + edge.b].position;
  result.known = edge.a & ~kEdgeVertexMask;
  result.isOpen = edge.right == kNoEdgeSide;
  vec3 along = result.b - result.a;
  result.left = cross(along, vertices[first + edge.left].position - result.a);
  result.right = vec3(0.0);
  if (!result.isOpen) result.right = cross(vertices[first + edge.right].position - result.a, along);
  return result;
}

// Cosine of the angle by which the surface turns there.
float bendOf(PlacedEdge edge) {
  return dot(edge.left, edge.right) * inversesqrt(max(dot(edge.left, edge.left) * dot(edge.right, edge.right), 1e-37));
}

// Of the kinds that are shown, the first one that it is, as a view sees it (paper 004, section 2.2: one of its triangles
// faces the eye, and the other one does not).
int kindOf(PlacedEdge edge, vec4 eye) {
  if (edge.isOpen) return ink.kinds[kInkBoundary].shown != 0u ? kInkBoundary : kInkNone;
  vec3 toEye = eye.xyz - eye.w * edge.a;
  bool isSilhouette = (dot(edge.left, toEye) < 0.0) != (dot(edge.right, toEye) < 0.0);
  if (isSilhouette && ink.kinds[kInkSilhouette].shown != 0u) return kInkSilhouette;
  if ((edge.known & kEdgeMaterialBorder) != 0u && ink.kinds[kInkMaterial].shown != 0u) return kInkMaterial;
  if (ink.kinds[kInkCrease].shown != 0u && bendOf(edge) < ink.cosCrease) return kInkCrease;
  if ((edge.known & kEdgeColorBorder) != 0u && ink.kinds[kInkColor].shown != 0u) return kInkColor;
  return kInkNone;
}
#endif
