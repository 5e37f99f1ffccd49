#include "scene/scene_data.h"

#include <glm/gtc/matrix_transform.hpp>

namespace scumble::scene {

glm::dmat4 Transform::matrix() const {
  glm::dmat4 m = glm::mat4_cast(rotation);
  for (int axis = 0; axis < 3; ++axis) m[axis] *= scale[axis];
  m[3] = glm::dvec4(translation, 1.0);
  return m;
}

void Bounds::add(const glm::vec3& p) {
  min = empty ? p : glm::min(min, p);
  max = empty ? p : glm::max(max, p);
  empty = false;
}

void Bounds::add(const Bounds& other) {
  if (other.empty) return;
  add(other.min);
  add(other.max);
}

glm::dmat4 worldToOrigin(const SceneData& scene) {
  return glm::translate(glm::dmat4(1.0), -scene.origin);
}

std::vector<glm::dmat4> worldMatrices(const SceneData& scene) {
  std::vector<glm::dmat4> world(scene.nodes.size());
  const glm::dmat4 above = worldToOrigin(scene);
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    world[i] = (node.parent >= 0 ? world[size_t(node.parent)] : above) * node.restTransform();
  }
  return world;
}

const std::vector<float>& restMorphWeights(const SceneData& scene, const Node& node) {
  return node.morphWeights.empty() ? scene.meshes[size_t(node.mesh)]->morphWeights : node.morphWeights;
}

}  // namespace scumble::scene
