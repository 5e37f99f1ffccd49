#include "features/ink/lines/edges_on_gpu.h"

#include <algorithm>
#include <glm/gtc/packing.hpp>
#include <set>
#include <tuple>

#include "features/ink/ink.shared.h"
#include "features/ink/lines/edge_bounds.h"
#include "features/ink/mesh_groups.h"
#include "scene/parallel.h"
#include "scene/seen.h"
#include "shading/frame.shared.h"

namespace scumble::ink {

namespace {

static_assert(scene::kMaterialBorder << 28 == shared::kEdgeMaterialBorder &&
              scene::kColorBorder << 28 == shared::kEdgeColorBorder &&
              scene::kRoundnessKnown << 28 == shared::kEdgeRoundnessKnown);

uint32_t moved(uint32_t vertex, uint32_t vertices) {
  return vertex == scene::MeshEdge::kNone ? shared::kNoEdgeSide : vertex + vertices;
}
shared::DrawnEdge drawn(const scene::MeshEdge& edge, uint32_t vertices) {
  return {(edge.a + vertices) | edge.kinds << 28, edge.b + vertices, edge.left + vertices,
          moved(edge.right, vertices)};
}

// `ends`, `seen`: of each edge, or of none.
shared::EdgeRing ringOf(const std::vector<scene::MeshEdge>& edges, const std::vector<uint32_t>& ends,
                        const std::vector<uint32_t>& seen, size_t e, uint32_t vertices) {
  const auto& beyond = edges[e].beyond;
  return {{moved(beyond[0], vertices), moved(beyond[1], vertices)},
          {moved(beyond[2], vertices), moved(beyond[3], vertices)},
          ends.empty() ? ~0u : ends[e],
          seen.empty() ? ~0u : seen[e]};
}

constexpr int kSeenParts = 32;
// How far from an edge its surface is looked at, texels.
constexpr float kSeenTexels = 1.5f;

// As shared::EdgeRing has it. Of what is blended, seen is what has at least half of the alpha that the
// primitive has anywhere: panes of glass have their lines, and smoke none around the card that it is painted
// on.
std::vector<uint32_t> seenOf(const scene::Primitive& primitive, const std::vector<scene::MeshEdge>& edges,
                             const scene::SurfaceAlpha& alpha, bool isBlended) {
  // The alpha beside a part of an edge, on the side of a third vertex.
  const auto beside = [&](const scene::MeshEdge& edge, uint32_t third, float part) {
    const float texels = std::min(alpha.texelsBetween(edge.a, third), alpha.texelsBetween(edge.b, third));
    const float inward = texels > 0 ? std::clamp(kSeenTexels / texels, 1e-3f, 0.25f) : 1e-3f;
    return alpha.at({edge.a, edge.b, third}, {(1 - inward) * (1 - part), (1 - inward) * part, inward});
  };
  float least = alpha.least();
  if (isBlended) {
    float most = 0;
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3)
      for (int part = 0; part < 4; ++part) {
        glm::vec3 weights(part == 3 ? 1.0f / 3 : 0.0f);
        if (part < 3) weights[part] = 1;
        const uint32_t* const corners = &primitive.indices[i];
        most = std::max(most, alpha.at({corners[0], corners[1], corners[2]}, weights));
      }
    least = std::max(least, 0.5f * most);
  }
  std::vector<uint32_t> seen(edges.size(), 0);
  for (size_t e = 0; e < edges.size(); ++e)
    for (int i = 0; i < kSeenParts; ++i) {
      const float part = (float(i) + 0.5f) / kSeenParts;
      if (beside(edges[e], edges[e].left, part) >= least ||
          (edges[e].right != scene::MeshEdge::kNone && beside(edges[e], edges[e].right, part) >= least))
        seen[e] |= 1u << i;
    }
  return seen;
}

// As an edge has it that goes the other way.
uint32_t reversed(uint32_t seen) {
  uint32_t result = 0;
  for (int i = 0; i < kSeenParts; ++i) result |= (seen >> i & 1) << (kSeenParts - 1 - i);
  return result;
}

// As shared::EdgeRing has them; none where the primitive says nothing of them.
std::vector<uint32_t> endsOf(const scene::Primitive& primitive, const std::vector<scene::MeshEdge>& edges) {
  std::vector<uint32_t> ends;
  const std::vector<float>&widths = primitive.outlineWidths, &roundness = primitive.roundness;
  if (widths.empty() && roundness.empty()) return ends;
  const auto at = [](const std::vector<float>& values, uint32_t vertex) {
    return values.empty() ? 1.0f : values[vertex];
  };
  for (const scene::MeshEdge& edge : edges)
    ends.push_back(glm::packUnorm4x8(
        {at(widths, edge.a), at(widths, edge.b), at(roundness, edge.a), at(roundness, edge.b)}));
  return ends;
}

}  // namespace

bool EdgesOnGpu::Found::isSeenOf(const scene::Material& other,
                                 const std::shared_ptr<const scene::TextureImage>& otherImage) const {
  return image == otherImage && material.alphaMode == other.alphaMode &&
         material.alphaCutoff == other.alphaCutoff && material.baseColor.a == other.baseColor.a &&
         material.baseColorTexture.uvSet == other.baseColorTexture.uvSet &&
         material.baseColorTexture.transform == other.baseColorTexture.transform &&
         material.baseColorTexture.sampler.wrapU == other.baseColorTexture.sampler.wrapU &&
         material.baseColorTexture.sampler.wrapV == other.baseColorTexture.sampler.wrapV;
}

void EdgesOnGpu::findSeen(const scene::SceneData& scene, const scene::Primitive& primitive, Found& found) {
  const scene::Material& material = scene.materials[size_t(primitive.material)];
  const int image = material.baseColorTexture.image;
  std::shared_ptr<const scene::TextureImage> shown;
  if (image >= 0) shown = scene.images[size_t(image)].keep();
  if (found.isSeenOf(material, shown)) return;
  std::vector<uint32_t> seen;
  const scene::SurfaceAlpha alpha(scene, primitive);
  if (!alpha.isWhole())
    seen = seenOf(primitive, found.edges, alpha, material.alphaMode == scene::AlphaMode::blend);
  isSeenOtherwise_ |= seen != found.seen;
  found.seen = std::move(seen);
  found.material = material, found.image = std::move(shown);
}

void EdgesOnGpu::find(const scene::SceneData& scene, const std::vector<GeometryItem>& items) {
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
    found[i].ends = endsOf(*missing[i], found[i].edges);
    found[i].bounds = boundsOf(*missing[i], found[i].edges);
  });
  for (size_t i = 0; i < missing.size(); ++i) edgesOf_[missing[i]] = std::move(found[i]);
  for (auto& [primitive, of] : edgesOf_) findSeen(scene, *primitive, of);

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
  if (edges_.handle() && known == known_ && !isSeenOtherwise_) return false;
  isSeenOtherwise_ = false;

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
          edges.push_back(drawn(own[e], 0)), rings.push_back(ringOf(own, found.ends, found.seen, e, 0));
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
        const Found& beyond = edgesOf_.at(other.primitive);
        const scene::MeshEdge &left = found.edges[between.edge], &right = beyond.edges[between.otherEdge];
        const uint32_t firstLeft = places[group[p]].firstVertex,
                       firstRight = places[group[between.otherPrimitive]].firstVertex;
        shared::DrawnEdge edge = drawn(left, firstLeft);
        edge.right = right.left + firstRight;
        edge.a |= between.kinds << 28;
        if (item.material != other.material) edge.a |= shared::kEdgeMaterialBorder;
        edges.push_back(edge);
        // To the right one, this edge goes the other way.
        shared::EdgeRing ring = ringOf(found.edges, found.ends, found.seen, between.edge, firstLeft);
        ring.seen |= beyond.seen.empty() ? ~0u : reversed(beyond.seen[between.otherEdge]);
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
