// Bounds of words of edges: where none of them can be a line, none is looked at.
#pragma once

#include <vector>

#include "features/ink/edge_bounds.shared.h"
#include "scene/mesh_edges.h"

namespace scumble::ink {

// The edges of a primitive in another order: those of a word are a patch, close together and turned alike.
// The order follows from the primitive alone.
std::vector<scene::MeshEdge> inPatches(const scene::Primitive& primitive,
                                       const std::vector<scene::MeshEdge>& edges);

// One for each kInkThreads edges of a primitive, in their order. None for primitives that bend.
std::vector<shared::EdgeBounds> boundsOf(const scene::Primitive& primitive,
                                         const std::vector<scene::MeshEdge>& edges);

}  // namespace scumble::ink
