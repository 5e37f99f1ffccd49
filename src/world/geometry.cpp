#include "world/geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "scene/seen.h"
#include "scene/surroundings.h"
#include "stage/light.h"
#include "world/ground.h"
#include "world/tessellate.h"

namespace scumble::world {

namespace {

constexpr float kFlatGround = 0.02f;  // height by width

constexpr size_t kMaxNewTriangles = 1 << 18;

void addGround(const scene::SceneData& scene, const std::vector<int>& materials, MadePrimitives& made,
               Geometry& geometry) {
  const scene::Bounds bounds = geometry.bounds;
  for (int tone = 0; tone < int(materials.size()); ++tone) {
    GeometryItem item;
    item.primitive =
        &made.get("ground",
                  {double(bounds.empty), bounds.min.x, bounds.min.y, bounds.min.z, bounds.max.x, bounds.max.y,
                   bounds.max.z, double(tone)},
                  [&] { return tone == 0 ? makeGround(bounds) : makeGroundStrokes(bounds, tone); });
    item.node = GeometryItem::kNoNode;
    item.material = uint32_t(materials[size_t(tone)]);
    item.extent = &item.primitive->extent;
    item.id = uint32_t(scene.nodes.size() + 1);
    item.casts = false;
    item.reach = item.extent->box;
    geometry.items.push_back(item);
  }
}

}  // namespace

float largestScale(const glm::mat3& m) {
  return std::max({glm::length(m[0]), glm::length(m[1]), glm::length(m[2])});
}

float longestEdge(float shadowWarp) {
  if (shadowWarp <= 0) return std::numeric_limits<float>::infinity();
  // The algebraic sigmoid's second derivative is at most 0.858; the warp scales t by the strength, and what
  // it has of the range to 2.
  const float range = 2 * shadowWarp / std::sqrt(1 + shadowWarp * shadowWarp);
  const float curvature = (1 - kEvenShare) * 2 * shadowWarp * shadowWarp * 0.858f / range;
  const float tolerance = 2.0f / float(kShadowMapSize);
  return std::sqrt(8 * tolerance / curvature);
}

const scene::Primitive& MadePrimitives::get(const std::string& kind, const std::vector<double>& key,
                                            const std::function<scene::Primitive()>& make) {
  Entry& entry = made_[{kind, key}];
  if (!entry.primitive) {
    entry.primitive = std::make_unique<scene::Primitive>(make());
    entry.primitive->extent = scene::extentOf(*entry.primitive);
  }
  entry.isUsed = true;
  return *entry.primitive;
}

const scene::Primitive& MadePrimitives::splitOf(const scene::Primitive& source, scene::Primitive&& result) {
  Entry& entry = split_[&source];
  // The same edges are split over a range of lengths. Nothing else of a source changes.
  if (!entry.primitive || entry.primitive->positions != result.positions ||
      entry.primitive->indices != result.indices) {
    if (entry.primitive) replaced_.push_back(std::move(entry.primitive));
    entry.primitive = std::make_unique<scene::Primitive>(std::move(result));
  }
  entry.isUsed = true;
  return *entry.primitive;
}

void MadePrimitives::sweep() {
  replaced_.clear();
  const auto sweep = [](auto& entries) {
    std::erase_if(entries, [](const auto& entry) { return !entry.second.isUsed; });
    for (auto& [key, entry] : entries) entry.isUsed = false;
  };
  sweep(made_), sweep(split_);
}

Geometry collectGeometry(const scene::SceneData& scene, const GeometryOptions& options,
                         const std::vector<int>& groundMaterials, const std::vector<int>& featureMaterials,
                         MadePrimitives& made) {
  Geometry geometry;
  geometry.bounds = scene::playedBounds(scene, options.clips);
  const std::vector<glm::dmat4> world = scene::worldMatrices(scene);

  // One item for each primitive of each node, and for each of its instances.
  const std::vector<glm::mat4> one{glm::mat4(1.0f)};
  std::vector<bool> isReplaced(scene.nodes.size(), false);
  for (const PlannedFeature& planned : options.features)
    if (planned.plan && planned.plan->replacedNode >= 0)
      isReplaced[size_t(planned.plan->replacedNode)] = true;
  std::vector<bool> shown = scene::everShownNodes(scene);
  for (const PlannedFeature& planned : options.features)
    if (planned.plan)
      for (const int node : planned.plan->hiddenNodes) shown[size_t(node)] = false;
  for (size_t n = 0; n < scene.nodes.size(); ++n) {
    const scene::Node& node = scene.nodes[n];
    if (node.mesh < 0 || isReplaced[n]) continue;
    const std::vector<scene::Primitive>& primitives = scene.meshes[size_t(node.mesh)]->primitives;
    for (size_t p = 0; p < primitives.size(); ++p) {
      const scene::Primitive& primitive = primitives[p];
      if (primitive.indices.empty()) continue;
      GeometryItem item;
      item.primitive = &primitive;
      item.node = n;
      item.material = uint32_t(primitive.material);
      item.id = uint32_t(n + 1);
      item.casts = options.casts[item.material];
      item.extent = &scene::seenExtent(scene, node.mesh, p);
      item.shown = shown[n] && scene::seenOf(scene, node.mesh, p).isSeen;
      if (node.skin >= 0 && primitive.influences > 0) item.skin = node.skin;
      for (size_t f = 0; f < options.features.size(); ++f)
        if (const auto& plan = options.features[f].plan)
          if (const std::optional<uint32_t> kind = plan->kindOf(n, item.material))
            item.feature = int(f), item.kind = *kind, item.isWrittenByFeature = true;
      for (const glm::mat4& instance : node.instances.empty() || item.skin >= 0 ? one : node.instances) {
        item.instance = instance;
        item.model = scene::instanceToWorld(world[n], instance);
        geometry.items.push_back(item);
        ++item.instanceOfNode;
      }
    }
  }

  // Where clips take them.
  const std::span<const glm::mat4> none;
  scene::forEachPose(scene, options.clips, [&](const scene::Pose& pose, auto joints) {
    for (GeometryItem& item : geometry.items)
      if (pose.shown[item.node])
        item.reach.add(scene::posedBounds(
            *item.extent, scene::instanceToWorld(pose.world[item.node], item.instance),
            item.skin >= 0 ? std::span(joints[size_t(item.skin)]) : none, pose.morphWeights[item.node]));
  });

  // Flat grounds far larger than what stands on them would have the whole shadow map to themselves.
  const std::vector<bool> around = scene::surroundings(scene);
  for (GeometryItem& item : geometry.items) {
    if (around.empty() || !around[item.node]) continue;
    const glm::vec3 size = item.reach.max - item.reach.min;
    if (size.y <= kFlatGround * std::max(size.x, size.z)) item.casts = false;
  }

  // Split casters that are too long for the shadow map's sigmoid: by the largest scale at which a primitive
  // is drawn.
  std::map<const scene::Primitive*, float> scales;
  scene::Bounds casters;
  for (const GeometryItem& item : geometry.items) {
    if (!item.casts) continue;
    if (item.shown) casters.add(item.reach);
    if (item.primitive->isPaint) continue;  // short, and drawn elsewhere as it is
    float& scale = scales[item.primitive];
    scale = std::max(scale, largestScale(glm::mat3(item.model)));
  }
  std::map<const scene::Primitive*, const scene::Primitive*> split;
  const float maxEdge = longestEdge(options.shadowWarp) * std::max(casters.radius(), 1e-6f);
  geometry.longestCasterEdge = maxEdge;
  for (const auto& [primitive, scale] : scales)
    if (scale > 0)
      if (auto result = tessellate(*primitive, maxEdge / scale, kMaxNewTriangles))
        split[primitive] = &made.splitOf(*primitive, std::move(*result));
  for (GeometryItem& item : geometry.items)
    if (const auto it = split.find(item.primitive); it != split.end()) item.primitive = it->second;

  // Those that have objects are numbered whether or not they are there.
  uint32_t id = uint32_t(scene.nodes.size() + 1);
  for (size_t f = 0; f < options.features.size(); ++f) {
    if (!options.features[f].feature->material().empty()) ++id;
    if (featureMaterials[f] < 0) continue;
    GeometryItem item;
    item.node = GeometryItem::kNoNode;
    item.material = uint32_t(featureMaterials[f]);
    item.id = id;  // as Frame::objects has them
    item.casts = false;
    item.feature = int(f);
    options.features[f].plan->addItems(item, made, geometry);
  }
  addGround(scene, groundMaterials, made, geometry);
  return geometry;
}

}  // namespace scumble::world
