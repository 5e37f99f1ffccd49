#include "scene/posed_bounds.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "scene/prepare_mesh.h"

namespace scumble::scene {

namespace {

void addBox(Bounds& bounds, const Bounds& box, const glm::mat4& matrix) {
  if (box.empty) return;
  // The box of a box: each axis by the matrix's absolute entries.
  const glm::vec3 center(matrix * glm::vec4(box.center(), 1.0f)), half = 0.5f * (box.max - box.min);
  const glm::vec3 reach = glm::abs(glm::vec3(matrix[0])) * half.x + glm::abs(glm::vec3(matrix[1])) * half.y +
                          glm::abs(glm::vec3(matrix[2])) * half.z;
  if (!isDrawable(center - reach) || !isDrawable(center + reach)) return;
  bounds.add(center - reach);
  bounds.add(center + reach);
}

// How far targets with these weights move vertices, at most.
void grow(Bounds& box, const std::vector<Bounds>& targets, std::span<const float> weights) {
  for (size_t t = 0; t < targets.size() && t < weights.size(); ++t) {
    if (targets[t].empty || weights[t] == 0) continue;
    const glm::vec3 a = weights[t] * targets[t].min, b = weights[t] * targets[t].max;
    box.min += glm::min(glm::min(a, b), glm::vec3(0.0f));
    box.max += glm::max(glm::max(a, b), glm::vec3(0.0f));
  }
}

glm::vec3 morphedPosition(const Primitive& primitive, size_t v, const std::vector<float>& weights) {
  glm::vec3 position = primitive.positions[v];
  for (size_t t = 0; t < primitive.morphTargets.size() && t < weights.size(); ++t)
    if (!primitive.morphTargets[t].positions.empty())
      position += weights[t] * primitive.morphTargets[t].positions[v];
  return position;
}

// Of so many vertices, spread over the primitive: boxes of more differ by little.
constexpr size_t kSampledVertices = 1024;

void addPrimitive(Bounds& bounds, const Primitive& primitive, const Node& node, const glm::mat4& world,
                  const std::vector<float>& weights, const std::vector<glm::mat4>& joints) {
  const Bounds& box = primitive.extent.box;
  const bool skinned = node.skin >= 0 && primitive.influences > 0;
  const bool morphs = !primitive.morphTargets.empty();
  if (!skinned && !morphs) {
    if (node.instances.empty()) addBox(bounds, box, world);
    for (const glm::mat4& instance : node.instances) addBox(bounds, box, world * instance);
    return;
  }
  const size_t step = std::max<size_t>(1, primitive.vertexCount() / kSampledVertices);
  for (size_t v = 0; v < primitive.vertexCount(); v += step) {
    const glm::vec3 own = morphedPosition(primitive, v, weights);
    const auto addPoint = [&](const glm::vec3& p) {
      if (isDrawable(p)) bounds.add(p);
    };
    if (skinned)
      addPoint(skinnedPosition(primitive, v, own, joints));
    else if (node.instances.empty())
      addPoint(glm::vec3(world * glm::vec4(own, 1.0f)));
    else
      for (const glm::mat4& instance : node.instances)
        addPoint(glm::vec3(world * instance * glm::vec4(own, 1.0f)));
  }
}

}  // namespace

std::vector<glm::mat4> jointMatrices(const Skin& skin, const std::vector<glm::mat4>& world) {
  std::vector<glm::mat4> matrices;
  matrices.reserve(skin.joints.size());
  for (size_t j = 0; j < skin.joints.size(); ++j)
    matrices.push_back(world[size_t(skin.joints[j])] * skin.inverseBindMatrices[j]);
  return matrices;
}

glm::vec3 skinnedPosition(const Primitive& primitive, size_t v, const glm::vec3& position,
                          std::span<const glm::mat4> joints) {
  glm::vec3 placed(0.0f);
  const size_t n = size_t(primitive.influences);
  for (size_t k = 0; k < n; ++k)
    if (const float weight = primitive.weights[v * n + k]; weight > 0.0f)
      placed += weight * glm::vec3(joints[primitive.joints[v * n + k]] * glm::vec4(position, 1.0f));
  return placed;
}

PrimitiveExtent extentOf(const Primitive& primitive) {
  PrimitiveExtent extent;
  extent.box = boxOf(primitive.positions);
  std::map<uint16_t, Bounds> joints;
  const size_t n = size_t(primitive.influences);
  for (size_t i = 0; i < primitive.weights.size(); ++i)
    if (primitive.weights[i] > 0.0f) joints[primitive.joints[i]].add(primitive.positions[i / n]);
  for (const auto& [joint, box] : joints) extent.joints.push_back({joint, box});
  for (const MorphTarget& target : primitive.morphTargets) extent.targets.push_back(boxOf(target.positions));
  // A target moves some vertices and leaves others.
  for (Bounds& target : extent.targets)
    if (!target.empty) target.add(glm::vec3(0.0f));
  for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
    const glm::vec3 &a = primitive.positions[primitive.indices[i]],
                    &b = primitive.positions[primitive.indices[i + 1]],
                    &c = primitive.positions[primitive.indices[i + 2]];
    extent.longestEdge2 = std::max(
        {extent.longestEdge2, glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
  }
  return extent;
}

Bounds posedBounds(const PrimitiveExtent& extent, const glm::mat4& model, std::span<const glm::mat4> joints,
                   std::span<const float> morphWeights) {
  Bounds bounds;
  if (joints.empty()) {
    Bounds box = extent.box;
    grow(box, extent.targets, morphWeights);
    addBox(bounds, box, model);
    return bounds;
  }
  for (const PrimitiveExtent::Joint& joint : extent.joints) {
    Bounds box = joint.box;
    grow(box, extent.targets, morphWeights);
    addBox(bounds, box, joints[joint.joint]);
  }
  return bounds;
}

void forEachPose(const SceneData& scene, std::span<const int> clips,
                 const std::function<void(const Pose&)>& body) {
  if (clips.empty()) body(poseAt(scene, {}, 0));
  for (const int index : clips) {
    PlayedClip played;
    played.clip = index;
    const double duration = scene.clips[size_t(index)].duration;
    const int samples = int(std::clamp(std::ceil(6 * duration), 1.0, 12.0));
    // Not quite the end, which would be the beginning again.
    for (int i = 0; i <= samples; ++i)
      body(poseAt(scene, {&played, 1}, std::min(duration * i / samples, duration * 0.9999)));
  }
}

Bounds playedBounds(const SceneData& scene, std::span<const int> clips) {
  if (clips.empty()) return scene.bounds;
  const std::vector<bool> shown = shownNodes(scene);
  Bounds bounds;
  forEachPose(scene, clips, [&](const Pose& pose) {
    std::vector<std::vector<glm::mat4>> joints;
    for (const Skin& skin : scene.skins) joints.push_back(jointMatrices(skin, pose.world));
    for (size_t n = 0; n < scene.nodes.size(); ++n) {
      const Node& node = scene.nodes[n];
      if (node.mesh < 0 || !shown[n]) continue;
      const Mesh& mesh = scene.meshes[size_t(node.mesh)];
      for (const Primitive& primitive : mesh.primitives)
        addPrimitive(bounds, primitive, node, pose.world[n], pose.morphWeights[n],
                     node.skin >= 0 ? joints[size_t(node.skin)] : std::vector<glm::mat4>());
    }
  });
  return bounds.empty ? scene.bounds : bounds;
}

}  // namespace scumble::scene
