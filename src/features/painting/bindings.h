// How strokes hang on a mesh: each point on the triangle that is nearest to it, at rest.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/painting.h"

namespace scumble::painting {

struct PointBinding {
  uint32_t primitive = 0;   // which one of those given
  glm::uvec3 vertices{0u};  // of it
  glm::vec2 at{0.0f};       // the second and the third corner's part of the foot
  float size = 0;           // of the triangle: the square root of twice its area
  // From the foot, in the triangle's frame: x along its first edge, z along the surface's own normal (those
  // of the corners, mixed).
  glm::vec3 offset{0.0f};
};

// One for each point; none where no primitive has a triangle with an area. Their vertices must be there.
std::vector<PointBinding> bindPoints(const scene::Painting& painting,
                                     std::span<const scene::Primitive* const> primitives);

}  // namespace scumble::painting
