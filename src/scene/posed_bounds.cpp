#include "scene/posed_bounds.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "scene/painting.h"
#include "scene/prepare_mesh.h"
#include "scene/seen.h"

namespace scumble::scene {

namespace {

void addBox(Bounds& bounds, const Bounds& box, const glm::mat4& matrix) {
  if (box.empty || !keepsArea(matrix)) return;
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

// The boxes that a primitive consists of, each with what places it in the world: its own, or those of its
// joints.
template <class Visit>
void forEachBox(const PrimitiveExtent& extent, const glm::mat4& model, std::span<const glm::mat4> joints,
                std::span<const float> morphWeights, Visit&& visit) {
  const auto grown = [&](Bounds box) {
    grow(box, extent.targets, morphWeights);
    return box;
  };
  if (joints.empty()) return visit(grown(extent.box), model);
  for (const PrimitiveExtent::Joint& joint : extent.joints) visit(grown(joint.box), joints[joint.joint]);
}

glm::mat4 meanOf(std::span<const glm::mat4> joints) {
  glm::mat4 sum(0.0f);
  for (const glm::mat4& joint : joints) sum += joint / float(joints.size());
  return joints.empty() ? glm::mat4(1.0f) : sum;
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

// A primitive as it is seen.
struct Seen {
  const Primitive& primitive;
  const PrimitiveExtent& extent;
  std::span<const uint32_t> vertices;  // empty: all
};

// `joints`: empty for what is not skinned, which `model` places.
void addPrimitive(Bounds& bounds, const Seen& seen, const glm::mat4& model, std::span<const glm::mat4> joints,
                  const std::vector<float>& weights) {
  const Primitive& primitive = seen.primitive;
  if (joints.empty() && primitive.morphTargets.empty()) return addBox(bounds, seen.extent.box, model);
  if (joints.empty() ? !keepsArea(model) : std::none_of(joints.begin(), joints.end(), keepsArea)) return;
  const size_t count = seen.vertices.empty() ? primitive.vertexCount() : seen.vertices.size();
  const size_t step = std::max<size_t>(1, count / kSampledVertices);
  for (size_t i = 0; i < count; i += step) {
    const size_t v = seen.vertices.empty() ? i : seen.vertices[i];
    const glm::vec3 own = morphedPosition(primitive, v, weights);
    const glm::vec3 placed =
        joints.empty() ? glm::vec3(model * glm::vec4(own, 1.0f)) : skinnedPosition(primitive, v, own, joints);
    if (isDrawable(placed)) bounds.add(placed);
  }
}

// What is seen of these nodes, at any time of these clips: visit(seen, model, joints, morph weights), once
// for each primitive and instance.
template <class Visit>
void forEachPlayed(const SceneData& scene, const std::vector<bool>& nodes, std::span<const int> clips,
                   Visit&& visit) {
  const std::span<const glm::mat4> none;
  forEachPose(scene, clips, [&](const Pose& pose, std::span<const std::vector<glm::mat4>> joints) {
    for (size_t n = 0; n < scene.nodes.size(); ++n) {
      const Node& node = scene.nodes[n];
      if (node.mesh < 0 || !nodes[n] || !pose.shown[n]) continue;
      const Mesh& mesh = scene.meshes[size_t(node.mesh)];
      for (size_t p = 0; p < mesh.primitives.size(); ++p) {
        const SeenPart& part = seenOf(scene, node.mesh, p);
        if (!part.isSeen) continue;
        const Seen seen{mesh.primitives[p], seenExtent(scene, node.mesh, p), part.vertices};
        const std::vector<float>& weights = pose.morphWeights[n];
        if (node.skin >= 0 && seen.primitive.influences > 0)
          visit(seen, glm::mat4(pose.world[n]), std::span(joints[size_t(node.skin)]), weights);
        else
          for (size_t i = 0; i < instanceCount(node); ++i)
            visit(seen, instanceToWorld(node, pose.world[n], i), none, weights);
      }
      // Where strokes are; what bends carries them along, about as its joints go on the average.
      if (!mesh.painting) continue;
      const Seen strokes{mesh.painting->hull, mesh.painting->hull.extent, {}};
      if (node.skin >= 0)
        visit(strokes, meanOf(joints[size_t(node.skin)]), none, {});
      else
        for (size_t i = 0; i < instanceCount(node); ++i)
          visit(strokes, instanceToWorld(node, pose.world[n], i), none, {});
    }
  });
}

}  // namespace

std::vector<glm::vec3> outermostOf(std::span<const glm::vec3> points, int directions) {
  if (points.empty()) return {};
  // Neighbours in a list mostly are neighbours: most blocks cannot have the outermost one.
  constexpr size_t kBlock = 64;
  std::vector<Bounds> blocks((points.size() + kBlock - 1) / kBlock);
  for (size_t i = 0; i < points.size(); ++i) blocks[i / kBlock].add(points[i]);
  // As if the box of all were a cube, so that points of what is long or flat are spread as well.
  Bounds all;
  for (const Bounds& block : blocks) all.add(block);
  const glm::vec3 size = glm::max(all.max - all.min, glm::vec3(1e-6f * std::max(all.radius(), 1e-30f)));
  std::vector<size_t> found;
  for (int k = 0; k < directions; ++k) {
    // Equal steps in height, each turned on by the golden angle.
    const float height = (2 * float(k) + 1) / float(directions) - 1, around = 2.3999632f * float(k);
    const float side = std::sqrt(1 - height * height);
    const glm::vec3 direction = glm::vec3(side * std::cos(around), height, side * std::sin(around)) / size;
    size_t farthest = 0;
    float most = glm::dot(points[0], direction);
    for (size_t b = 0; b < blocks.size(); ++b) {
      const glm::vec3 corner = glm::max(direction * blocks[b].min, direction * blocks[b].max);
      if (corner.x + corner.y + corner.z <= most) continue;
      for (size_t i = b * kBlock; i < std::min(points.size(), (b + 1) * kBlock); ++i)
        if (const float along = glm::dot(points[i], direction); along > most) most = along, farthest = i;
    }
    found.push_back(farthest);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  std::vector<glm::vec3> outermost;
  outermost.reserve(found.size());
  for (const size_t i : found) outermost.push_back(points[i]);
  return outermost;
}

std::vector<glm::vec3> playedOutline(const SceneData& scene, const std::vector<bool>& nodes,
                                     std::span<const int> clips) {
  constexpr int kDirections = 200;
  constexpr size_t kMost = 8192;  // at a time
  std::vector<glm::vec3> points;
  const auto add = [&](const glm::vec3& p) {
    if (points.size() == kMost) points = outermostOf(points, kDirections);
    if (isDrawable(p)) points.push_back(p);
  };
  forEachPlayed(scene, nodes, clips,
                [&](const Seen& seen, const glm::mat4& model, std::span<const glm::mat4> joints,
                    const std::vector<float>& weights) {
                  const PrimitiveExtent& extent = seen.extent;
                  if (joints.empty() && seen.primitive.morphTargets.empty()) {
                    if (!keepsArea(model)) return;
                    for (size_t i = 0; i < extent.outermostCount; ++i)
                      add(glm::vec3(model * glm::vec4(extent.outermost[i], 1.0f)));
                    return;
                  }
                  forEachBox(extent, model, joints, weights, [&](const Bounds& box, const glm::mat4& matrix) {
                    if (!keepsArea(matrix)) return;
                    for (int corner = 0; !box.empty && corner < 8; ++corner)
                      add(glm::vec3(matrix * glm::vec4(box.corner(corner), 1.0f)));
                  });
                });
  return outermostOf(points, kDirections);
}

std::vector<glm::mat4> jointMatrices(const Skin& skin, const std::vector<glm::dmat4>& world) {
  std::vector<glm::mat4> matrices;
  matrices.reserve(skin.joints.size());
  for (size_t j = 0; j < skin.joints.size(); ++j)
    matrices.emplace_back(world[size_t(skin.joints[j])] * glm::dmat4(skin.inverseBindMatrices[j]));
  return matrices;
}

size_t instanceCount(const Node& node) {
  return std::max<size_t>(1, node.instances.size());
}

glm::mat4 instanceToWorld(const Node& node, const glm::dmat4& world, size_t instance) {
  return node.instances.empty() ? glm::mat4(world) : instanceToWorld(world, node.instances[instance]);
}

glm::mat4 instanceToWorld(const glm::dmat4& world, const glm::mat4& instance) {
  return glm::mat4(world * glm::dmat4(instance));
}

glm::mat4 restPlaceOf(const SceneData& scene, const std::vector<glm::dmat4>& world, size_t node) {
  const int skin = scene.nodes[node].skin;
  return skin < 0 ? glm::mat4(world[node]) : meanOf(jointMatrices(scene.skins[size_t(skin)], world));
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

PrimitiveExtent extentOf(const Primitive& primitive, std::span<const uint32_t> vertices) {
  Primitive part;
  const size_t n = size_t(primitive.influences);
  const auto gather = [&](const auto& from, auto& to, size_t each) {
    if (from.empty()) return;
    for (const uint32_t v : vertices)
      to.insert(to.end(), from.begin() + ptrdiff_t(v * each), from.begin() + ptrdiff_t((v + 1) * each));
  };
  gather(primitive.positions, part.positions, 1);
  gather(primitive.joints, part.joints, n);
  gather(primitive.weights, part.weights, n);
  part.influences = primitive.influences;
  for (const MorphTarget& target : primitive.morphTargets)
    gather(target.positions, part.morphTargets.emplace_back().positions, 1);
  PrimitiveExtent extent = extentOf(part);
  extent.longestEdge2 = primitive.extent.longestEdge2;
  return extent;
}

PrimitiveExtent extentOf(const Primitive& primitive) {
  PrimitiveExtent extent;
  extent.box = boxOf(primitive.positions);
  if (primitive.influences == 0 && primitive.morphTargets.empty()) {
    const std::vector<glm::vec3> outermost = outermostOf(primitive.positions, int(extent.outermost.size()));
    std::copy(outermost.begin(), outermost.end(), extent.outermost.begin());
    extent.outermostCount = outermost.size();
  }
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
  forEachBox(extent, model, joints, morphWeights,
             [&](const Bounds& box, const glm::mat4& matrix) { addBox(bounds, box, matrix); });
  return bounds;
}

std::vector<int> allClips(const SceneData& scene) {
  std::vector<int> clips(scene.clips.size());
  std::iota(clips.begin(), clips.end(), 0);
  return clips;
}

void forEachPose(
    const SceneData& scene, std::span<const int> clips,
    const std::function<void(const Pose&, std::span<const std::vector<glm::mat4>> joints)>& body) {
  const auto visit = [&](const Pose& pose) {
    std::vector<std::vector<glm::mat4>> joints;
    for (const Skin& skin : scene.skins) joints.push_back(jointMatrices(skin, pose.world));
    body(pose, joints);
  };
  if (clips.empty()) visit(poseAt(scene, {}, 0));
  for (const int index : clips) {
    PlayedClip played;
    played.clip = index;
    const double duration = scene.clips[size_t(index)].duration;
    const int samples = int(std::clamp(std::ceil(6 * duration), 1.0, 12.0));
    // Not quite the end, which would be the beginning again.
    for (int i = 0; i <= samples; ++i)
      visit(poseAt(scene, {&played, 1}, std::min(duration * i / samples, duration * 0.9999)));
  }
}

Bounds playedBounds(const SceneData& scene, std::span<const int> clips) {
  if (clips.empty()) return scene.bounds;
  Bounds bounds;
  forEachPlayed(
      scene, std::vector<bool>(scene.nodes.size(), true), clips,
      [&](const Seen& seen, const glm::mat4& model, std::span<const glm::mat4> joints,
          const std::vector<float>& weights) { addPrimitive(bounds, seen, model, joints, weights); });
  return bounds.empty ? scene.bounds : bounds;
}

}  // namespace scumble::scene
