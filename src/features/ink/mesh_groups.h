// Which items are one mesh at one place.
#pragma once

#include <vector>

#include "world/geometry.h"

namespace scumble::ink {

using MeshGroup = std::vector<uint32_t>;  // items

// Of all but the ground, and what features draw.
std::vector<MeshGroup> meshGroups(const std::vector<world::GeometryItem>& items);
std::vector<const scene::Primitive*> primitivesOf(const std::vector<world::GeometryItem>& items,
                                                  const MeshGroup& group);

}  // namespace scumble::ink
