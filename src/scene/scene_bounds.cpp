#include "scene/scene_bounds.h"

#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "scene/import_budget.h"
#include "scene/prepare_mesh.h"

namespace scumble::scene {

namespace {

bool isDrawable(const glm::vec3& p) {
  return std::abs(p.x) <= kMaxCoordinate && std::abs(p.y) <= kMaxCoordinate &&
         std::abs(p.z) <= kMaxCoordinate;
}

bool isDrawable(const glm::mat4& m) {
  for (int i = 0; i < 16; ++i)
    if (!(std::abs(glm::value_ptr(m)[i]) <= kMaxCoordinate)) return false;
  return true;
}

// The object's box with its morph targets at their default weights. Each is added at its extremes, so the box
// may be a little large, never too small.
Bounds boxOf(const Mesh& mesh, const std::vector<float>& weights) {
  Bounds bounds;
  for (const Primitive& p : mesh.primitives) {
    Bounds box;
    for (const glm::vec3& position : p.positions) box.add(position);
    for (size_t t = 0; t < p.morphTargets.size() && t < weights.size(); ++t) {
      if (weights[t] == 0.0f || p.morphTargets[t].positions.empty()) continue;
      Bounds offsets;
      for (const glm::vec3& d : p.morphTargets[t].positions) offsets.add(weights[t] * d);
      box.min += glm::min(offsets.min, glm::vec3(0.0f));
      box.max += glm::max(offsets.max, glm::vec3(0.0f));
    }
    if (!box.empty) {
      bounds.add(box.min);
      bounds.add(box.max);
    }
  }
  return bounds;
}

glm::vec3 corner(const Bounds& box, int i) {
  return {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z};
}

bool addBox(const Bounds& box, const glm::mat4& matrix, Bounds& bounds) {
  glm::vec3 corners[8];
  for (int i = 0; i < 8; ++i) {
    corners[i] = glm::vec3(matrix * glm::vec4(corner(box, i), 1.0f));
    if (!isDrawable(corners[i])) return false;
  }
  for (const glm::vec3& c : corners) bounds.add(c);
  return true;
}

// Vertices where their joints put them; the node's own place does not count then.
bool addSkinned(const SceneData& scene, const Node& node, const std::vector<glm::mat4>& world,
                Bounds& bounds) {
  const Skin& skin = scene.skins[node.skin];
  std::vector<glm::mat4> joints(skin.joints.size());
  for (size_t i = 0; i < joints.size(); ++i) joints[i] = world[skin.joints[i]] * skin.inverseBindMatrices[i];
  for (const Primitive& p : scene.meshes[node.mesh].primitives)
    for (size_t i = 0; i < p.vertexCount(); ++i) {
      glm::vec3 position(0.0f);
      for (int k = 0; k < p.influences; ++k) {
        const float weight = p.weights[i * p.influences + k];
        if (weight > 0.0f)
          position +=
              weight * glm::vec3(joints[p.joints[i * p.influences + k]] * glm::vec4(p.positions[i], 1.0f));
      }
      if (p.influences == 0) position = p.positions[i];
      if (!isDrawable(position)) return false;
      bounds.add(position);
    }
  return true;
}

size_t trianglesOf(const Mesh& mesh) {
  size_t triangles = 0;
  for (const Primitive& p : mesh.primitives) triangles += p.indices.size() / 3;
  return triangles;
}

}  // namespace

void placeScene(SceneData& scene, ImportWarnings& warnings) {
  const std::vector<glm::mat4> world = worldMatrices(scene);
  for (size_t i = 0; i < world.size(); ++i)
    if (!isDrawable(world[i]))
      fail("nodes",
           "the transformation of node \"" + scene.nodes[i].name.substr(0, 80) +
               "\" leads out of what numbers can hold",
           "check the scales in the scene");

  std::vector<Bounds> boxes(scene.meshes.size());
  for (size_t i = 0; i < boxes.size(); ++i) boxes[i] = boxOf(scene.meshes[i], scene.meshes[i].morphWeights);
  uint64_t drawn = 0;
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    Node& node = scene.nodes[i];
    if (node.mesh < 0) continue;
    const Mesh& mesh = scene.meshes[node.mesh];
    if (mesh.primitives.empty()) {
      node.mesh = node.skin = -1;
      node.instances.clear();
      continue;
    }
    Bounds bounds = scene.bounds;
    bool good = true;
    if (node.skin >= 0) {
      good = addSkinned(scene, node, world, bounds);
    } else {
      const Bounds box = node.morphWeights.empty() ? boxes[node.mesh] : boxOf(mesh, node.morphWeights);
      if (node.instances.empty()) good = addBox(box, world[i], bounds);
      for (const glm::mat4& instance : node.instances)
        good = good && addBox(box, world[i] * instance, bounds);
    }
    if (!good) {
      warnings.add("nodes", "a mesh that lies absurdly far away is left out");
      node.mesh = node.skin = -1;
      node.instances.clear();
      continue;
    }
    scene.bounds = bounds;
    drawn += trianglesOf(mesh) * std::max<uint64_t>(1, node.instances.size());
    if (drawn > ImportBudget::kMaxDrawnTriangles)
      fail("nodes",
           "more than " + std::to_string(ImportBudget::kMaxDrawnTriangles) + " triangles would be drawn",
           "reduce the instances or the meshes");
  }
  if (scene.bounds.empty)
    fail({}, "holds nothing to draw", "a scene needs at least one node with a mesh of triangles");
}

}  // namespace scumble::scene
