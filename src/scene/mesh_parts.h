// The connected pieces of meshes.
#pragma once

#include <span>
#include <vector>

#include "scene/scene_data.h"

namespace scumble::scene {

// By primitive and vertex, which piece it is of, from 0 in the order of first vertices. `primitives` lie in
// one space; what triangles join is one piece, also from one primitive to another, and vertices that share a
// place are one, so that split normals and seams of a mapping part nothing.
std::vector<std::vector<uint32_t>> partsOf(std::span<const Primitive* const> primitives);

}  // namespace scumble::scene
