#include "rocks.h"

namespace demo {

void addRock(meshkit::MeshBuilder& mesh, const RockShape& shape,
             const std::function<int(glm::vec3 normal, glm::vec3 center)>& paint) {
  std::vector<glm::vec3> points;
  std::vector<glm::uvec3> faces;
  meshkit::icosphere(shape.levels, points, faces);
  meshkit::Random random(shape.seed);
  for (int i = 0; i < shape.cuts; ++i) {
    glm::vec3 normal = random.direction();
    normal.y = std::abs(normal.y) * 0.8f;
    normal = glm::normalize(normal);
    const float depth = random.between(0.62f, 0.86f);
    for (glm::vec3& p : points) {
      const float over = glm::dot(p, normal) - depth;
      if (over > 0.0f) p -= over * normal;
    }
  }
  // A little unevenness, so that large cuts still break into facets.
  for (glm::vec3& p : points) p *= 1.0f + random.between(-0.008f, 0.008f);
  const float c = std::cos(shape.turn), s = std::sin(shape.turn);
  for (glm::vec3& p : points) {
    p *= shape.halfSize;
    p = shape.center + glm::vec3(c * p.x + s * p.z, p.y, c * p.z - s * p.x);
    if (p.y > shape.top) p.y = shape.top + 0.15f * (p.y - shape.top);
  }
  mesh.indexed(points, faces, meshkit::Shading::flat, paint);
}

}  // namespace demo
