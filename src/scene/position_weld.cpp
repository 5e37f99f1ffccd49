#include "scene/position_weld.h"

#include <algorithm>

namespace scumble::scene {

PositionGrid gridOf(std::span<const Primitive* const> primitives) {
  Bounds box;
  for (const Primitive* primitive : primitives)
    for (const glm::vec3& position : primitive->positions) box.add(position);
  const glm::vec3 size = box.max - box.min;
  const float extent = std::max({size.x, size.y, size.z});
  return PositionGrid(extent > 0 ? 1 / extent : 1);
}

}  // namespace scumble::scene
