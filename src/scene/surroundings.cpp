#include "scene/surroundings.h"

#include <algorithm>

#include "scene/painting.h"
#include "scene/posed_bounds.h"
#include "scene/seen.h"

namespace scumble::scene {

namespace {

constexpr float kFarLarger = 8.0f;  // radii

Bounds boundsOf(const SceneData& scene, const Node& node, const Pose& pose,
                std::span<const std::vector<glm::mat4>> joints) {
  const size_t n = size_t(&node - scene.nodes.data());
  Bounds bounds;
  const Mesh& mesh = scene.meshes[size_t(node.mesh)];
  for (size_t p = 0; p < mesh.primitives.size(); ++p) {
    const Primitive& primitive = mesh.primitives[p];
    if (!seenOf(scene, node.mesh, p).isSeen) continue;
    const bool bends = node.skin >= 0 && primitive.influences > 0;
    const std::span<const glm::mat4> own =
        bends ? std::span<const glm::mat4>(joints[size_t(node.skin)]) : std::span<const glm::mat4>();
    const auto place = [&](const glm::mat4& model) {
      bounds.add(posedBounds(seenExtent(scene, node.mesh, p), model, own, pose.morphWeights[n]));
    };
    for (size_t i = 0; i < (bends ? 1 : instanceCount(node)); ++i)
      place(instanceToWorld(node, pose.world[n], i));
  }
  // What bends carries its strokes along, and tells about where they are.
  if (!mesh.painting || node.skin >= 0) return bounds;
  const PrimitiveExtent& strokes = mesh.painting->hull.extent;
  for (size_t i = 0; i < instanceCount(node); ++i)
    bounds.add(posedBounds(strokes, instanceToWorld(node, pose.world[n], i), {}, {}));
  return bounds;
}

}  // namespace

std::vector<bool> surroundings(const SceneData& scene) {
  struct Low {
    size_t node;
    Bounds bounds;
  };
  std::vector<Low> low;
  Bounds subjects;
  forEachPose(scene, {}, [&](const Pose& pose, std::span<const std::vector<glm::mat4>> joints) {
    for (size_t n = 0; n < scene.nodes.size(); ++n) {
      if (scene.nodes[n].mesh < 0 || !pose.shown[n]) continue;
      const Bounds bounds = boundsOf(scene, scene.nodes[n], pose, joints);
      if (bounds.empty) continue;
      if (bounds.isLow())
        low.push_back({n, bounds});
      else
        subjects.add(bounds);
    }
  });
  std::stable_sort(low.begin(), low.end(),
                   [](const Low& a, const Low& b) { return a.bounds.radius() < b.bounds.radius(); });
  for (size_t i = 0; i < low.size(); ++i) {
    if (!subjects.empty && low[i].bounds.radius() > kFarLarger * subjects.radius()) {
      std::vector<bool> found(scene.nodes.size());
      for (; i < low.size(); ++i) found[low[i].node] = true;
      return found;
    }
    subjects.add(low[i].bounds);
  }
  return {};
}

}  // namespace scumble::scene
