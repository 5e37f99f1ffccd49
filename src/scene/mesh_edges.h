// The edges of meshes, with what lies on both sides of each: what silhouettes, creases and borders are found
// from. Vertices that share a place are one, so that split normals and seams of a mapping open nothing.
#pragma once

#include <array>
#include <span>

#include "scene/scene_data.h"

namespace scumble::scene {

// What is known of an edge before anything moves. Bits.
enum EdgeKind : uint32_t {
  kMaterialBorder = 1,  // its two triangles are of two primitives, which have materials of their own
  kColorBorder = 2,     // vertex colours differ across it
  kRoundnessKnown = 4,  // the primitive says how round it is
};

// Between two triangles that are wound alike, or at the end of one. Vertices are indices into a primitive's.
struct MeshEdge {
  static constexpr uint32_t kNone = ~0u;
  uint32_t a = 0, b = 0;   // of the left triangle, which goes from a to b
  uint32_t left = 0;       // the left triangle's third vertex
  uint32_t right = kNone;  // the right one's; none: the surface ends here
  uint32_t kinds = 0;      // EdgeKind
  // Where the surface goes on: third vertices of the triangles across b to left, left to a, a to right and
  // right to b; none: there is none in this primitive.
  std::array<uint32_t, 4> beyond{kNone, kNone, kNone, kNone};
  bool operator==(const MeshEdge&) const = default;
};

// Every edge once, in an order that follows from the primitive alone. Triangles without area, and such as
// have the same three places as another one, count for nothing. Where more than two triangles meet, those
// that are wound against each other are paired, the first with the first; what is left over ends there.
std::vector<MeshEdge> edgesOf(const Primitive& primitive);

// Edges at which one primitive of a mesh goes on in another one.
struct SharedEdge {
  uint32_t primitive = 0, otherPrimitive = 0;  // which ones
  uint32_t edge = 0, otherEdge = 0;            // of their edges, both without a right side
  uint32_t kinds = 0;                          // EdgeKind that both are together
};
// `edges`: edgesOf() each of `primitives`, which lie in one space. Each edge is shared once at most.
std::vector<SharedEdge> sharedEdges(std::span<const Primitive* const> primitives,
                                    std::span<const std::vector<MeshEdge>* const> edges);

}  // namespace scumble::scene
