#include "scene/pose.h"

#include <algorithm>
#include <cmath>

namespace scumble::scene {

namespace {

void addBox(Bounds& bounds, const Bounds& box, const glm::mat4& matrix) {
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 p(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                      corner & 4 ? box.max.z : box.min.z);
    bounds.add(glm::vec3(matrix * glm::vec4(p, 1.0f)));
  }
}

}  // namespace

std::vector<std::vector<glm::mat4>> jointMatrices(const SceneData& scene,
                                                  const std::vector<glm::mat4>& world) {
  std::vector<std::vector<glm::mat4>> result;
  for (const Skin& skin : scene.skins) {
    auto& matrices = result.emplace_back();
    for (size_t j = 0; j < skin.joints.size(); ++j)
      matrices.push_back(world[size_t(skin.joints[j])] * skin.inverseBindMatrices[j]);
  }
  return result;
}

glm::vec3 skinnedPosition(const Primitive& primitive, size_t v, const std::vector<glm::mat4>& joints) {
  glm::vec3 position(0.0f);
  const size_t n = size_t(primitive.influences);
  for (size_t k = 0; k < n; ++k)
    position += primitive.weights[v * n + k] *
                glm::vec3(joints[primitive.joints[v * n + k]] * glm::vec4(primitive.positions[v], 1.0f));
  return position;
}

Bounds posedBounds(const Primitive& primitive, const Node& node, const glm::mat4& nodeWorld,
                   const std::vector<std::vector<glm::mat4>>& joints) {
  Bounds bounds;
  if (node.skin >= 0 && primitive.influences > 0) {
    for (size_t v = 0; v < primitive.vertexCount(); ++v)
      bounds.add(skinnedPosition(primitive, v, joints[size_t(node.skin)]));
    return bounds;
  }
  Bounds box;
  for (const glm::vec3& p : primitive.positions) box.add(p);
  if (box.empty) return bounds;
  if (node.instances.empty()) addBox(bounds, box, nodeWorld);
  for (const glm::mat4& instance : node.instances) addBox(bounds, box, nodeWorld * instance);
  return bounds;
}

}  // namespace scumble::scene
