// Levels of detail: fewer triangles of the same vertices, for where a primitive is drawn small.
#pragma once

#include <span>

#include "scene/scene_data.h"

namespace scumble::scene {

// Fills `levels` and `levelIndices` of a primitive that is finished, with its extent: the first has a
// quarter of the triangles, each other one a third of those of the one before, or some more where no more can
// go. None for what has few.
void makeLevels(Primitive& primitive);

// How far what a primitive looks like has moved where these triangles of its vertices are drawn instead:
// metres, at vertices from all over it. `nearest`: by vertex, one that the triangles have,
// near it on the same side of all seams.
struct Strays {
  float surface;   // itself
  float textures;  // along it, by uv0 and uv1
  float drawn;  // the surface and colours, and the parts that count of how far patterns and light have moved
};
Strays straysOf(const Primitive& primitive, std::span<const uint32_t> triangles,
                std::span<const uint32_t> nearest);

}  // namespace scumble::scene
