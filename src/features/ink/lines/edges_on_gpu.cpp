#include "features/ink/lines/edges_on_gpu.h"

#include <algorithm>
#include <glm/gtc/packing.hpp>
#include <set>
#include <tuple>

#include "features/ink/ink.shared.h"
#include "features/ink/lines/edge_bounds.h"
#include "features/ink/mesh_groups.h"
#include "scene/parallel.h"
#include "shading/frame.shared.h"

namespace scumble::ink {

namespace {

static_assert(scene::kMaterialBorder << 28 == shared::kEdgeMaterialBorder &&
              scene::kColorBorder << 28 == shared::kEdgeColorBorder &&
              scene::kRoundnessKnown << 28 == shared::kEdgeRoundnessKnown &&
              uint32_t(scene::kRound) << 28 == shared::kEdgeRound);

uint32_t moved(uint32_t vertex, uint32_t vertices) {
  return vertex == scene::MeshEdge::kNone ? shared::kNoEdgeSide : vertex + vertices;
}
shared::DrawnEdge drawn(const scene::MeshEdge& edge, uint32_t vertices) {
  return {(edge.a + vertices) | edge.kinds << 28, edge.b + vertices, edge.left + vertices,
          moved(edge.right, vertices)};
}

// `widths`: of each edge, or of none.
shared::EdgeRing ringOf(const std::vector<scene::MeshEdge>& edges, const std::vector<uint32_t>& widths,
                        size_t e, uint32_t vertices) {
  const auto& beyond = edges[e].beyond;
  return {{moved(beyond[0], vertices), moved(beyond[1], vertices)},
          {moved(beyond[2], vertices), moved(beyond[3], vertices)},
          widths.empty() ? ~0u : widths[e]};
}

std::vector<uint32_t> widthsOf(const scene::Primitive& primitive, const std::vector<scene::MeshEdge>& edges) {
  std::vector<uint32_t> widths;
  if (primitive.outlineWidths.empty()) return widths;
  for (const scene::MeshEdge& edge : edges)
    widths.push_back(glm::packUnorm2x16({primitive.outlineWidths[edge.a], primitive.outlineWidths[edge.b]}));
  return widths;
}

}  // namespace

void EdgesOnGpu::find(const std::vector<GeometryItem>& items) {
  const std::vector<MeshGroup> groups = meshGroups(items);
  std::set<const scene::Primitive*> used;
  std::vector<const scene::Primitive*> missing;
  for (const MeshGroup& group : groups)
    for (const scene::Primitive* primitive : primitivesOf(items, group))
      if (used.insert(primitive).second && !edgesOf_.contains(primitive)) missing.push_back(primitive);
  std::erase_if(edgesOf_, [&](const auto& entry) { return !used.contains(entry.first); });
  std::vector<Found> found(missing.size());
  scene::parallelFor(missing.size(), scene::threadCount(0), [&](size_t i) {
    found[i].edges = inPatches(*missing[i], scene::edgesOf(*missing[i]));
    found[i].widths = widthsOf(*missing[i], found[i].edges);
    found[i].bounds = boundsOf(*missing[i], found[i].edges);
  });
  for (size_t i = 0; i < missing.size(); ++i) edgesOf_[missing[i]] = std::move(found[i]);

  std::set<std::vector<const scene::Primitive*>> meshes;
  for (const MeshGroup& group : groups)
    if (group.size() > 1) meshes.insert(primitivesOf(items, group));
  std::erase_if(sharedBy_, [&](const auto& entry) { return !meshes.contains(entry.first); });
  for (const auto& primitives : meshes) {
    const auto [entry, isNew] = sharedBy_.try_emplace(primitives);
    if (!isNew) continue;
    std::vector<const std::vector<scene::MeshEdge>*> edges;
    for (const scene::Primitive* primitive : primitives) edges.push_back(&edgesOf_.at(primitive).edges);
    entry->second = scene::sharedEdges(primitives, edges);
  }
}

bool EdgesOnGpu::update(gpu::Device& device, gpu::Uploader& uploader, const std::vector<GeometryItem>& items,
                        const std::vector<GeometryOnGpu::Place>& places,
                        const std::function<void()>& settle) {
  std::vector<Known> known;
  for (size_t i = 0; i < items.size(); ++i)
    known.push_back({items[i].primitive, places[i].firstVertex, places[i].firstRest, items[i].shown});
  if (edges_.handle() && known == known_) return false;

  std::vector<shared::DrawnEdge> edges;
  std::vector<shared::EdgeRing> rings;
  std::vector<shared::EdgeChunk> chunks;
  std::vector<shared::EdgeBounds> bounds;
  edgeCount_ = 0;
  constexpr uint32_t kWord = uint32_t(shared::kInkThreads);
  // Both ends of an edge are of its object.
  const auto addChunks = [&](uint32_t first, uint32_t count, uint32_t firstBounds, uint32_t firstVertex,
                             uint32_t object) {
    edgeCount_ += count;
    const uint32_t restShift = places[object].firstRest - places[object].firstVertex;
    for (uint32_t e = 0; e < count; e += shared::kEdgeChunk) {
      const uint32_t own = firstBounds == shared::kNoEdgeBounds ? firstBounds : firstBounds + e / kWord;
      chunks.push_back({first + e, std::min(count - e, uint32_t(shared::kEdgeChunk)), firstVertex, object,
                        own, restShift});
    }
  };
  struct Run {
    uint32_t first = 0, count = 0, firstBounds = shared::kNoEdgeBounds;
  };
  // Of a primitive, but for edges at which it goes on in another one; those depend on the mesh.
  std::map<std::tuple<const scene::Primitive*, const std::vector<scene::SharedEdge>*, uint32_t>, Run> runs;
  for (const MeshGroup& group : meshGroups(items)) {
    if (!items[group[0]].shown) continue;
    const std::vector<scene::SharedEdge>* shared = nullptr;
    if (group.size() > 1) shared = &sharedBy_.at(primitivesOf(items, group));
    for (uint32_t p = 0; p < group.size(); ++p) {
      const GeometryItem& item = items[group[p]];
      const Found& found = edgesOf_.at(item.primitive);
      const std::vector<scene::MeshEdge>& own = found.edges;
      const auto [run, isNew] = runs.try_emplace({item.primitive, shared, shared ? p : 0});
      if (isNew) {
        run->second.first = uint32_t(edges.size());
        std::vector<bool> isShared(own.size(), false);
        if (shared)
          for (const scene::SharedEdge& edge : *shared) {
            if (edge.primitive == p) isShared[edge.edge] = true;
            if (edge.otherPrimitive == p) isShared[edge.otherEdge] = true;
          }
        if (!found.bounds.empty()) run->second.firstBounds = uint32_t(bounds.size());
        bounds.insert(bounds.end(), found.bounds.begin(), found.bounds.end());
        for (size_t e = 0; e < own.size(); ++e) {
          edges.push_back(drawn(own[e], 0)), rings.push_back(ringOf(own, found.widths, e, 0));
          // Words of bounds stay as they are.
          if (isShared[e]) edges.back() = {};
        }
        run->second.count = uint32_t(edges.size()) - run->second.first;
      }
      addChunks(run->second.first, run->second.count, run->second.firstBounds, places[group[p]].firstVertex,
                group[p]);
    }
    // Those have vertices of two items.
    if (!shared || shared->empty()) continue;
    for (uint32_t p = 0; p < group.size(); ++p) {
      const uint32_t first = uint32_t(edges.size());
      for (const scene::SharedEdge& between : *shared) {
        if (between.primitive != p) continue;
        const GeometryItem &item = items[group[p]], &other = items[group[between.otherPrimitive]];
        const Found& found = edgesOf_.at(item.primitive);
        const scene::MeshEdge &left = found.edges[between.edge],
                              &right = edgesOf_.at(other.primitive).edges[between.otherEdge];
        const uint32_t firstLeft = places[group[p]].firstVertex,
                       firstRight = places[group[between.otherPrimitive]].firstVertex;
        shared::DrawnEdge edge = drawn(left, firstLeft);
        edge.right = right.left + firstRight;
        if (item.material != other.material) edge.a |= shared::kEdgeMaterialBorder;
        edges.push_back(edge);
        // To the right one, this edge goes the other way.
        shared::EdgeRing ring = ringOf(found.edges, found.widths, between.edge, firstLeft);
        for (int i = 0; i < 2; ++i) ring.beyondRight[i] = moved(right.beyond[i], firstRight);
        rings.push_back(ring);
      }
      addChunks(first, uint32_t(edges.size()) - first, shared::kNoEdgeBounds, 0, group[p]);
    }
  }

  // Vertices have 28 bits; of edges that are lines there are numbers.
  if (finalVertexCount(items, places) > shared::kEdgeVertexMask)
    throw gpu::VulkanError{"lines of so large a scene", VK_ERROR_OUT_OF_DEVICE_MEMORY};
  device.requireBindable(edgeCount_ * sizeof(uint32_t), "lines of so large a scene");
  known_ = std::move(known);
  settle();
  // What was there goes first.
  edges_ = {}, rings_ = {}, chunks_ = {}, bounds_ = {};
  edges_ = uploader.storage<shared::DrawnEdge>(edges);
  rings_ = uploader.storage<shared::EdgeRing>(rings);
  chunks_ = uploader.storage<shared::EdgeChunk>(chunks);
  bounds_ = uploader.storage<shared::EdgeBounds>(bounds);
  chunkCount_ = uint32_t(chunks.size());
  return true;
}

}  // namespace scumble::ink
