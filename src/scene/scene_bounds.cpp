#include "scene/scene_bounds.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "scene/import_failure.h"
#include "scene/painting.h"
#include "scene/posed_bounds.h"
#include "scene/prepare_mesh.h"
#include "scene/seen.h"

namespace scumble::scene {

namespace {

// Instances and repeated meshes included.
constexpr uint64_t kMaxDrawnTriangles = 1ull << 28, kMaxDrawnStrokePoints = 1ull << 22;

// The box of what is seen of a mesh, and how far each of its morph targets can move it.
struct MeshBox {
  Bounds box;
  std::vector<Bounds> offsets;
};

MeshBox measure(const SceneData& scene, size_t number) {
  const Mesh& mesh = scene.meshes[number];
  MeshBox result;
  result.offsets.resize(mesh.morphWeights.size());
  for (size_t p = 0; p < mesh.primitives.size(); ++p) {
    if (!seenOf(scene, int(number), p).isSeen) continue;
    const PrimitiveExtent& extent = seenExtent(scene, int(number), p);
    result.box.add(extent.box);
    for (size_t t = 0; t < extent.targets.size() && t < result.offsets.size(); ++t)
      result.offsets[t].add(extent.targets[t]);
  }
  if (mesh.painting) result.box.add(mesh.painting->hull.extent.box);
  return result;
}

// Every target is added at its extremes, so the box may be a little large, never too small.
Bounds morphed(const MeshBox& mesh, const std::vector<float>& weights) {
  Bounds bounds = mesh.box;
  for (size_t t = 0; t < mesh.offsets.size() && t < weights.size(); ++t) {
    if (mesh.offsets[t].empty) continue;
    const glm::vec3 a = weights[t] * mesh.offsets[t].min, b = weights[t] * mesh.offsets[t].max;
    bounds.min += glm::min(glm::min(a, b), glm::vec3(0.0f));
    bounds.max += glm::max(glm::max(a, b), glm::vec3(0.0f));
  }
  return bounds;
}

// False where it is not drawable.
bool addBox(const Bounds& box, const glm::mat4& matrix, Bounds& bounds) {
  if (box.empty || !keepsArea(matrix)) return true;
  glm::vec3 corners[8];
  for (int i = 0; i < 8; ++i) {
    corners[i] = glm::vec3(matrix * glm::vec4(box.corner(i), 1.0f));
    if (!isDrawable(corners[i])) return false;
  }
  for (const glm::vec3& c : corners) bounds.add(c);
  return true;
}

// The box of the vertices that are seen where their joints put them (the node's own place does not count
// then); nothing when it is not drawable. `morphedOwn` is the mesh's own box with its morph targets.
std::optional<Bounds> skinnedBox(const SceneData& scene, const Node& node,
                                 const std::vector<glm::dmat4>& world, const Bounds& own,
                                 const Bounds& morphedOwn) {
  const Mesh& mesh = scene.meshes[size_t(node.mesh)];
  const std::vector<glm::mat4> joints = jointMatrices(scene.skins[size_t(node.skin)], world);
  Bounds bounds;
  if (own.empty || std::none_of(joints.begin(), joints.end(), keepsArea)) return bounds;
  for (size_t k = 0; k < mesh.primitives.size(); ++k) {
    const Primitive& p = mesh.primitives[k];
    const SeenPart& seen = seenOf(scene, node.mesh, k);
    if (!seen.isSeen) continue;
    if (p.influences == 0) {
      bounds.add(seenExtent(scene, node.mesh, k).box);
      continue;
    }
    const size_t count = seen.vertices.empty() ? p.vertexCount() : seen.vertices.size();
    for (size_t i = 0; i < count; ++i) {
      const size_t v = seen.vertices.empty() ? i : seen.vertices[i];
      const glm::vec3 position = skinnedPosition(p, v, p.positions[v], joints);
      if (!isDrawable(position)) return std::nullopt;
      bounds.add(position);
    }
  }
  // Rotations may turn a displacement anywhere: its largest reach counts in all directions.
  const glm::vec3 low = own.min - morphedOwn.min, high = morphedOwn.max - own.max;
  const glm::vec3 growth(glm::length(glm::max(low, high)));
  bounds.min -= growth;
  bounds.max += growth;
  return isDrawable(bounds.min) && isDrawable(bounds.max) ? std::optional(bounds) : std::nullopt;
}

size_t trianglesOf(const Mesh& mesh) {
  size_t triangles = 0;
  for (const Primitive& p : mesh.primitives) triangles += p.indexCount() / 3;
  return triangles;
}

}  // namespace

void findOrigin(SceneData& scene) {
  scene.origin = glm::dvec3(0.0);
  // Bounding balls of what is drawn; a skinned mesh stands at its first joint. Of a million instances a few
  // thousand suffice.
  struct Ball {
    glm::dvec3 middle;
    double radius;
  };
  std::vector<Ball> balls;
  const std::vector<glm::dmat4> world = worldMatrices(scene);
  constexpr size_t kInstances = 4096;
  for (size_t n = 0; n < scene.nodes.size(); ++n) {
    const Node& node = scene.nodes[n];
    if (node.mesh < 0) continue;
    Bounds box;
    for (const Primitive& primitive : scene.meshes[size_t(node.mesh)]->primitives)
      box.add(primitive.extent.box);
    if (const auto& painting = scene.meshes[size_t(node.mesh)]->painting) box.add(painting->hull.extent.box);
    if (box.empty) continue;
    const std::vector<int>* const joints = node.skin >= 0 ? &scene.skins[size_t(node.skin)].joints : nullptr;
    const auto add = [&](const glm::dmat4& place, const glm::dvec3& middle) {
      const glm::dvec3 there(place * glm::dvec4(middle, 1.0));
      if (isDrawable(glm::vec3(there)) && isDrawable(place))
        balls.push_back({there, double(box.radius()) * glm::length(place[0])});
    };
    if (joints) {
      if (!joints->empty()) add(world[size_t(joints->front())], glm::dvec3(0.0));
      continue;
    }
    const size_t step = 1 + instanceCount(node) / kInstances;
    for (size_t i = 0; i < instanceCount(node); i += step)
      add(node.instances.empty() ? world[n] : world[n] * glm::dmat4(node.instances[i]),
          glm::dvec3(box.center()));
  }
  if (balls.empty()) return;
  // The median along each axis, which single things that stand elsewhere do not move.
  const auto middleOf = [&](auto&& number) {
    std::vector<double> numbers;
    for (const Ball& ball : balls) numbers.push_back(number(ball));
    const auto middle = numbers.begin() + ptrdiff_t(numbers.size() / 2);
    std::nth_element(numbers.begin(), middle, numbers.end());
    return *middle;
  };
  glm::dvec3 middle;
  for (int axis = 0; axis < 3; ++axis)
    middle[axis] = middleOf([&](const Ball& ball) { return ball.middle[axis]; });
  const double radius =
      middleOf([&](const Ball& ball) { return glm::length(ball.middle - middle) + ball.radius; });
  // A step of a power of ten metres, hundreds of radii long: near scenes stay where they are, and patterns
  // that lie in the world lie alike in scenes that stand whole steps apart.
  const double step =
      std::pow(10.0, std::clamp(std::ceil(std::log10(std::max(radius, 1e-9))) + 2, -3.0, 3.0));
  scene.origin = step * glm::round(middle / step);
}

void placeScene(SceneData& scene, ImportWarnings& warnings) {
  // Transformations that numbers can hold.
  findOrigin(scene);
  const std::vector<glm::dmat4> world = worldMatrices(scene);
  for (size_t i = 0; i < world.size(); ++i)
    if (!isDrawable(world[i]))
      fail("nodes",
           "the transformation of node \"" + scene.nodes[i].name.substr(0, 80) +
               "\" leads out of what numbers can hold",
           "check the scales in the scene");

  // Boxes of meshes.
  scene.bounds = {};
  findSeen(scene);
  const std::vector<bool> shown = shownNodes(scene);
  std::vector<MeshBox> boxes;
  for (size_t m = 0; m < scene.meshes.size(); ++m) boxes.push_back(measure(scene, m));

  // Boxes of nodes, in the world.
  std::map<std::pair<int, int>, std::optional<Bounds>>
      skinned;  // by mesh and skin: the node's place does not matter
  uint64_t drawn = 0, strokePoints = 0;
  for (Node& node : scene.nodes) {
    if (node.mesh < 0) continue;
    const Mesh& mesh = scene.meshes[node.mesh];
    if (mesh.painting) {
      strokePoints += mesh.painting->points.size() * std::max<uint64_t>(1, node.instances.size());
      if (strokePoints > kMaxDrawnStrokePoints)
        fail("nodes",
             "strokes of more than " + std::to_string(kMaxDrawnStrokePoints) + " points would be drawn",
             "reduce the instances or the strokes");
    }
    drawn += trianglesOf(mesh) * (node.skin >= 0 ? 1 : std::max<uint64_t>(1, node.instances.size()));
    if (drawn > kMaxDrawnTriangles)
      fail("nodes", "more than " + std::to_string(kMaxDrawnTriangles) + " triangles would be drawn",
           "reduce the instances or the meshes");

    Bounds bounds = scene.bounds;
    bool good = !mesh.primitives.empty() || mesh.painting;
    if (good) {
      const MeshBox& own = boxes[node.mesh];
      const Bounds box = morphed(own, node.morphWeights.empty() ? mesh.morphWeights : node.morphWeights);
      const size_t index = static_cast<size_t>(&node - scene.nodes.data());
      if (node.skin >= 0) {
        node.instances.clear();  // joints place the vertices; the extension has no say then
        const auto [entry, isNew] = skinned.try_emplace({node.mesh, node.skin});
        if (isNew) entry->second = skinnedBox(scene, node, world, own.box, box);
        good = entry->second.has_value();
        if (good) bounds.add(*entry->second);
        if (mesh.painting)
          good = good && addBox(mesh.painting->hull.extent.box, restPlaceOf(scene, world, index), bounds);
      } else {
        for (size_t k = 0; k < instanceCount(node); ++k)
          good = good && addBox(box, instanceToWorld(node, world[index], k), bounds);
      }
      if (!good) warnings.add("nodes", "a mesh that lies absurdly far away is left out");
    }
    if (good) {
      if (shown[size_t(&node - scene.nodes.data())]) scene.bounds = bounds;
    } else {
      node.mesh = node.skin = -1;
      node.instances.clear();
      node.morphWeights.clear();
    }
  }
  // What appears in the course of a clip, or grows from nothing, is all that there is to frame then.
  if (!scene.bounds.empty || scene.clips.empty()) return;
  scene.bounds = playedBounds(scene, allClips(scene));
}

void requireMeshes(const SceneData& scene) {
  const auto draws = [&](const Node& node) {
    if (node.mesh < 0) return false;
    const Mesh& mesh = scene.meshes[size_t(node.mesh)];
    return !mesh.primitives.empty() || mesh.painting;
  };
  if (std::none_of(scene.nodes.begin(), scene.nodes.end(), draws))
    fail({}, "holds nothing to draw", "a scene needs at least one node with a mesh of triangles, or strokes");
}

}  // namespace scumble::scene
