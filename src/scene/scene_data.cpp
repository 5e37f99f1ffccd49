#include "scene/scene_data.h"

#include <glm/gtc/matrix_transform.hpp>

namespace scumble::scene {

glm::mat4 Transform::matrix() const {
  glm::mat4 m = glm::mat4_cast(rotation);
  m[0] *= scale.x;
  m[1] *= scale.y;
  m[2] *= scale.z;
  m[3] = glm::vec4(translation, 1.0f);
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

std::vector<glm::mat4> worldMatrices(const SceneData& scene) {
  std::vector<glm::mat4> world(scene.nodes.size());
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    const glm::mat4 local = node.restTransform();
    world[i] = node.parent >= 0 ? world[node.parent] * local : local;
  }
  return world;
}

const std::vector<float>& restMorphWeights(const SceneData& scene, const Node& node) {
  return node.morphWeights.empty() ? scene.meshes[size_t(node.mesh)]->morphWeights : node.morphWeights;
}

}  // namespace scumble::scene
