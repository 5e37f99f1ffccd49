// The inside of a vessel: where water cannot come, whatever the sea around it does (paper 000, section 6.2).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "features/ocean/hulls/voxel_grid.h"

namespace scumble::ocean {

// Depth inside of it, at the points of a grid. The zero between them lies on the mesh, however thin that
// is.
struct HullField {
  glm::ivec3 size{0};     // points; y is up
  glm::mat4 toPoints{1};  // from where the triangles are, to numbers of points
  // Cells to the mesh, above 0 within: 127 are kCutoutReach.
  std::vector<int8_t> within;
  float top = 0;  // the highest point of the inside, below its rim
  // Numbers of points; some of those along it, the first few of which lie all around it as well.
  std::vector<glm::vec3> rim;

  int8_t at(const glm::ivec3& point) const {
    return within[(size_t(point.y) * size_t(size.z) + size_t(point.z)) * size_t(size.x) + size_t(point.x)];
  }
};

// None where they hold no water, as seen with y up: what has no bottom, or no rim, or a deck over all of it.
// What they hold when they heel or pitch a little counts as well. Metres; a pure function. Meshes of more
// triangles and cubes than can be looked through in about a second hold none.
std::optional<HullField> findHull(std::span<const Triangle> triangles);

// The inside of what an artist says is the inside: closed meshes, of which all that is within them is.
std::optional<HullField> fillHull(std::span<const Triangle> triangles);

}  // namespace scumble::ocean
