// An edge as it is drawn, and what kind of line it is.
#ifndef SCUMBLE_INK_EDGE_GLSL
#define SCUMBLE_INK_EDGE_GLSL
#extension GL_EXT_buffer_reference_uvec2 : require
#include "../../shading/frame.glsl"
#include "ink_choices.glsl"

layout(set = 1, binding = kInkBlock, scalar) uniform Ink { InkUniforms ink; };
layout(set = 1, binding = kInkChunks, scalar) readonly buffer Chunks { EdgeChunk chunks[]; };
layout(buffer_reference, buffer_reference_align = 4, scalar) readonly buffer Edges { DrawnEdge at[]; };
layout(buffer_reference, buffer_reference_align = 4, scalar) readonly buffer Vertices { VertexCore at[]; };

DrawnEdge edgeOf(uint place) { return Edges(ink.addresses.edges).at[place]; }
vec3 positionOf(uint vertex) { return Vertices(ink.addresses.vertices).at[vertex].position; }

// Where a view is seen from: xyz - w * p points from p to there; or, for all of them, the middle between them.
vec4 directionOf(int view) {
  mat4 toEye = VIEW_FIELD(worldToEye, view);
  return vec4(toEye[0][2], toEye[1][2], toEye[2][2], 0.0);
}
vec4 eyeOf(int view) {
  vec4 parallel = kCyclopean ? 0.5 * (directionOf(0) + directionOf(kViewCount - 1)) : directionOf(view);
  vec3 point = kCyclopean ? frame.viewer : VIEW_FIELD(eye, view);
  return mix(vec4(point, 1.0), parallel, VIEW_FIELD(orthographic, view));
}

struct PlacedEdge {
  vec3 a, b;             // world
  vec3 left, right;      // normals of the triangles, as long as twice their area; as they are wound
  uint known;            // kEdgeMaterialBorder ...
  bool isOpen, isNone;
};

PlacedEdge placed(DrawnEdge edge, uint first) {
  PlacedEdge result;
  result.a = positionOf(first + (edge.a & kEdgeVertexMask));
  result.b = positionOf(first + edge.b);
  result.known = edge.a & ~kEdgeVertexMask;
  result.isOpen = edge.right == kNoEdgeSide;
  vec3 along = result.b - result.a;
  // What is not seen has shrunk to a point.
  result.isNone = (edge.a & kEdgeVertexMask) == edge.b || dot(along, along) == 0.0;
  result.left = cross(along, positionOf(first + edge.left) - result.a);
  result.right = vec3(0.0);
  if (!result.isOpen) result.right = cross(positionOf(first + edge.right) - result.a, along);
  return result;
}

// Cosine of the angle by which the surface turns there. Areas of triangles of kilometres and of micrometres are squared, and
// the product of two such squares would be none that floats hold.
float bendOf(PlacedEdge edge) {
  const float kLeast = 1e-37;
  return dot(edge.left * inversesqrt(max(dot(edge.left, edge.left), kLeast)),
             edge.right * inversesqrt(max(dot(edge.right, edge.right), kLeast)));
}

// How much of its width a crease has.
float creaseOf(PlacedEdge edge) { return 1.0 - smoothstep(ink.cosCreaseFull, ink.cosCrease, bendOf(edge)); }

// Of the kinds that are shown, the first one that it is from everywhere.
int innerKindOf(PlacedEdge edge) {
  if ((edge.known & kEdgeMaterialBorder) != 0u && isShown(kInkMaterial)) return kInkMaterial;
  // What is not wholly a crease is a border of colours first.
  bool isColor = (edge.known & kEdgeColorBorder) != 0u && isShown(kInkColor);
  if (isShown(kInkCrease) && bendOf(edge) < (isColor ? ink.cosCreaseFull : ink.cosCrease)) return kInkCrease;
  if (isColor) return kInkColor;
  return kInkNone;
}

// Which side of a triangle an eye sees: 1 its front, -1 its back, 0 its edge, but for what rounding does to the sine.
const float kInkEdgeOn = 2e-5;
int sideOf(vec3 normal, vec3 toEye) {
  float along = dot(normal, toEye);
  if (along * along <= kInkEdgeOn * kInkEdgeOn * dot(normal, normal) * dot(toEye, toEye)) return 0;
  return along > 0.0 ? 1 : -1;
}

// Of the kinds that are shown, the first one that it is, as a view sees it (paper 004, section 2.2: one of its triangles
// faces the eye, and the other one does not). A triangle that is seen from its edge is neither, so that what it joins to the
// one and what it joins to the other are outlines: seen from there they lie one upon the other.
int kindOf(PlacedEdge edge, vec4 eye) {
  if (edge.isNone) return kInkNone;
  if (edge.isOpen) return isShown(kInkBoundary) ? kInkBoundary : kInkNone;
  vec3 toEye = eye.xyz - eye.w * edge.a;
  bool isSilhouette = sideOf(edge.left, toEye) != sideOf(edge.right, toEye);
  return isSilhouette && isShown(kInkSilhouette) ? kInkSilhouette : innerKindOf(edge);
}
#endif
