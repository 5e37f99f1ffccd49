#include "bake/orders.h"

#include <algorithm>
#include <array>

namespace scumble::bake {

std::vector<glm::vec3> orderDirections(int count) {
  std::vector<glm::vec3> directions;
  if (count == 6 || count == 14)
    for (int axis = 0; axis < 3; ++axis)
      for (const float sign : {1.0f, -1.0f}) {
        glm::vec3 direction(0.0f);
        direction[axis] = sign;
        directions.push_back(direction);
      }
  if (count == 8 || count == 14)
    for (int corner = 0; corner < 8; ++corner)
      directions.push_back(glm::normalize(
          glm::vec3(corner & 1 ? -1.0f : 1.0f, corner & 2 ? -1.0f : 1.0f, corner & 4 ? -1.0f : 1.0f)));
  return directions;
}

std::vector<uint32_t> orderedTowards(const std::vector<gltf::PaintPart>& parts, const glm::vec3& toViewer) {
  struct Triangle {
    std::array<uint32_t, 3> vertices;
    float nearness;
  };
  std::vector<Triangle> triangles;
  uint32_t first = 0;
  for (const gltf::PaintPart& part : parts) {
    for (size_t i = 0; i + 2 < part.indices.size(); i += 3) {
      Triangle triangle{{}, 0};
      for (size_t c = 0; c < 3; ++c) {
        triangle.vertices[c] = first + part.indices[i + c];
        triangle.nearness += glm::dot(part.positions[part.indices[i + c]], toViewer);
      }
      triangles.push_back(triangle);
    }
    first += uint32_t(part.positions.size());
  }
  std::stable_sort(triangles.begin(), triangles.end(),
                   [](const Triangle& a, const Triangle& b) { return a.nearness < b.nearness; });
  std::vector<uint32_t> indices;
  indices.reserve(3 * triangles.size());
  for (const Triangle& triangle : triangles)
    indices.insert(indices.end(), triangle.vertices.begin(), triangle.vertices.end());
  return indices;
}

}  // namespace scumble::bake
