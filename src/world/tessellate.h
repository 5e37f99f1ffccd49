// Splits long triangles, because the shadow map's sigmoid bends what is straight (FORMULAS 13): no edge of
// what this returns is longer than the cap. Triangles that share an edge split it alike, so nothing tears.
#pragma once

#include <optional>

#include "scene/scene_data.h"

namespace scumble::world {

// Nothing if no edge is longer than `maxEdge` (object space), as its extent says, or if the primitive deforms
// (skin, morph targets). Stops early rather than add more than `maxNewTriangles`.
std::optional<scene::Primitive> tessellate(const scene::Primitive& primitive, float maxEdge,
                                           size_t maxNewTriangles);

}  // namespace scumble::world
