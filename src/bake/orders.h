// Orders of triangles for engines that sort objects, and not triangles.
#pragma once

#include <vector>

#include "gltf/add_fins.h"

namespace scumble::bake {

// Each from everything to a viewer far away, unit length: 6 along the axes, 8 to the corners of a cube, 14
// for both. Others: none.
std::vector<glm::vec3> orderDirections(int count);

// All triangles of all parts, from far to near as a viewer in that direction has them; equals as they come.
// Vertices are counted through all parts.
std::vector<uint32_t> orderedTowards(const std::vector<gltf::PaintPart>& parts, const glm::vec3& toViewer);

}  // namespace scumble::bake
