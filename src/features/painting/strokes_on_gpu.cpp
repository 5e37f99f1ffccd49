#include "features/painting/strokes_on_gpu.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "base/tileable_noise.h"
#include "features/painting/painting.h"
#include "scene/posed_bounds.h"
#include "scene/seen.h"
#include "scene/splat_places.h"
#include "world/geometry.h"
#include "world/vertex_codes.h"

namespace scumble::painting {

namespace {

uint32_t packColor(const glm::vec4& linear) {
  return glm::packUnorm4x8(glm::vec4(glm::sqrt(glm::vec3(linear)), linear.a));
}

std::vector<const scene::Primitive*> primitivesOf(const std::vector<GeometryItem>& items,
                                                  const std::vector<size_t>& which) {
  std::vector<const scene::Primitive*> primitives;
  for (const size_t item : which) primitives.push_back(items[item].primitive);
  return primitives;
}

scene::Bounds meshBox(const std::vector<GeometryItem>& items, const std::vector<size_t>& which) {
  scene::Bounds box;
  for (const size_t item : which) box.add(items[item].extent->box);
  return box;
}

}  // namespace

std::vector<DrawnPainting> paintingsOf(const scene::SceneData& scene) {
  std::vector<DrawnPainting> drawn;
  const std::vector<bool> shown = scene::everShownNodes(scene);
  for (size_t n = 0; n < scene.nodes.size(); ++n) {
    const scene::Node& node = scene.nodes[n];
    if (node.mesh < 0 || !shown[n]) continue;
    const scene::Mesh& mesh = scene.meshes[size_t(node.mesh)];
    if (!mesh.painting || mesh.painting->strokes.empty()) continue;
    if (node.instances.empty()) drawn.push_back({n, 0, glm::mat4(1.0f), mesh.painting});
    for (size_t i = 0; i < node.instances.size(); ++i)
      drawn.push_back({n, i, node.instances[i], mesh.painting});
  }
  return drawn;
}

StrokesOnGpu::StrokesOnGpu(const scene::SceneData& scene, std::vector<DrawnPainting> paintings)
    : paintings_(std::move(paintings)), reachAlone_(paintings_.size()) {
  scene::forEachPose(scene, scene::allClips(scene), [&](const scene::Pose& pose, auto) {
    for (size_t p = 0; p < paintings_.size(); ++p)
      if (pose.shown[paintings_[p].node])
        reachAlone_[p].add(scene::posedBounds(
            paintings_[p].painting->hull.extent,
            scene::instanceToWorld(pose.world[paintings_[p].node], paintings_[p].toNode), {}, {}));
  });
}

const StrokesOnGpu* strokesOf(const frame::FrameBuilder& frame) {
  const auto here = frame.scene().feature(kName);
  return here ? &static_cast<const PaintingMoment*>(here->moment)->strokes() : nullptr;
}

std::vector<std::vector<size_t>> StrokesOnGpu::carriers(const std::vector<GeometryItem>& items) const {
  std::map<std::pair<size_t, size_t>, size_t> paintingOf;
  for (size_t p = 0; p < paintings_.size(); ++p) paintingOf[{paintings_[p].node, paintings_[p].instance}] = p;
  std::vector<std::vector<size_t>> carriers(paintings_.size());
  for (size_t i = 0; i < items.size(); ++i) {
    const auto found = paintingOf.find({items[i].node, items[i].instanceOfNode});
    if (found != paintingOf.end() && items[i].primitive->indexCount() > 0 && !items[i].primitive->isPaint)
      carriers[found->second].push_back(i);
  }
  return carriers;
}

void StrokesOnGpu::find(const std::vector<GeometryItem>& items) {
  std::map<std::pair<const scene::Painting*, Carrier>, std::vector<PointBinding>> found;
  const std::vector<std::vector<size_t>> all = carriers(items);
  reach_ = reachAlone_;
  for (size_t p = 0; p < paintings_.size(); ++p) {
    if (all[p].empty()) continue;
    // As far from what carries them as they are at rest.
    scene::Bounds& reach = reach_[p] = {};
    float scale = 0;
    for (const size_t item : all[p]) {
      reach.add(items[item].reach);
      scale = std::max(scale, largestScale(glm::mat3(items[item].model)));
    }
    const scene::Bounds &strokes = paintings_[p].painting->hull.extent.box, &mesh = meshBox(items, all[p]);
    const glm::vec3 beyond =
        glm::max(glm::max(mesh.min - strokes.min, strokes.max - mesh.max), glm::vec3(0.0f));
    if (!reach.empty && !mesh.empty)
      reach.min -= scale * glm::length(beyond), reach.max += scale * glm::length(beyond);
    const Carrier carrier = primitivesOf(items, all[p]);
    const std::pair key{paintings_[p].painting.get(), carrier};
    if (found.contains(key)) continue;
    const auto known = bindings_.find(key);
    found[key] =
        known != bindings_.end() ? std::move(known->second) : bindPoints(*paintings_[p].painting, carrier);
  }
  bindings_ = std::move(found);
}

bool StrokesOnGpu::update(gpu::Device& device, gpu::Uploader& uploader,
                          const std::vector<GeometryItem>& items, const std::vector<GeometryPlace>& places,
                          const std::function<void()>& settle) {
  std::vector<std::pair<const scene::Primitive*, uint32_t>> known;
  for (size_t i = 0; i < items.size(); ++i) known.emplace_back(items[i].primitive, places[i].firstVertex);
  if (points_.handle() && known == known_) return false;
  known_ = std::move(known);
  device.requireBindable(finalVertexCount(items, places) * sizeof(shared::VertexCore),
                         "a painting in so large a scene");

  // As many as may be.
  std::map<const scene::Painting*, size_t> copies;
  for (const DrawnPainting& drawn : paintings_) ++copies[drawn.painting.get()];
  const auto countAt = [&](float least) {
    double count = 0;
    for (const auto& [painting, times] : copies) count += double(times) * scene::splatCount(*painting, least);
    return count;
  };
  float least = scene::kSplatSpacing;
  while (countAt(least) > scene::kMostSplats) least *= 2;
  std::map<const scene::Painting*, std::pair<std::vector<scene::SplatPlace>, std::vector<float>>> placesOf;
  for (const auto& [painting, times] : copies) {
    auto& [splats, along] = placesOf[painting];
    splats = scene::splatPlaces(*painting, along, least);
  }

  const std::vector<std::vector<size_t>> all = carriers(items);
  std::vector<shared::StrokePoint> points;
  std::vector<shared::Splat> splats;
  for (size_t p = 0; p < paintings_.size(); ++p) {
    const scene::Painting& painting = *paintings_[p].painting;
    const auto& [own, along] = placesOf.at(&painting);
    const std::vector<PointBinding>* bindings = nullptr;
    if (!all[p].empty()) {
      const auto found = bindings_.find({&painting, primitivesOf(items, all[p])});
      if (found != bindings_.end() && !found->second.empty()) bindings = &found->second;
    }
    const auto first = uint32_t(points.size());
    for (size_t s = 0; s < painting.strokes.size(); ++s) {
      const scene::Stroke& stroke = painting.strokes[s];
      const uint32_t last = stroke.firstPoint + stroke.pointCount - 1;
      const uint32_t chance = scene::strokeChance(s);
      for (uint32_t i = stroke.firstPoint; i <= last; ++i) {
        const scene::StrokePoint& from = painting.points[i];
        shared::StrokePoint point{};
        point.position = from.position;
        point.radius = from.radius;
        point.normal = encodeNormal(from.orientation * glm::vec3(0, 0, 1));
        point.axis = encodeNormal(from.orientation * glm::vec3(1, 0, 0));
        point.shape = glm::packUnorm4x8(glm::vec4(from.shape, 0));
        point.color = packColor(from.color);
        point.time = from.time;
        point.order = float(s + 1) / float(painting.strokes.size());
        point.along = along[i];
        point.whole = along[last];
        point.flags = (i == stroke.firstPoint ? shared::kFirstOfStroke : 0) |
                      (i == last ? shared::kLastOfStroke : 0) | uint32_t(stroke.brush) << 8 | chance << 16;
        point.object = uint32_t(p);
        point.vertices = glm::uvec3(shared::kUnbound);
        // Gaussians lie in space: what they show has an extent of its own.
        if (bindings && stroke.brush != scene::Brush::gaussian) {
          const PointBinding& binding = (*bindings)[i];
          point.position = binding.offset;
          point.normal = encodeNormal({0, 0, 1});  // as the surface faces
          point.vertices = binding.vertices + places[all[p][binding.primitive]].firstVertex;
          point.at = binding.at;
          point.size = binding.size;
        }
        points.push_back(point);
      }
    }
    for (const scene::SplatPlace& place : own)
      splats.push_back({first + place.point, place.toNext, place.spacing});
  }
  settle();
  // What was there goes first.
  points_ = {}, splats_ = {}, placed_ = {};
  points_ = uploader.storage<shared::StrokePoint>(points);
  splats_ = uploader.storage<shared::Splat>(splats);
  device.requireBindable(std::max(points_.size(), splats_.size()), "so large a painting");
  placed_ = gpu::Buffer(device, std::max<size_t>(1, points.size()) * sizeof(shared::PlacedPoint),
                        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::MemoryKind::device);
  pointCount_ = uint32_t(points.size());
  splatCount_ = uint32_t(splats.size());
  return true;
}

}  // namespace scumble::painting
