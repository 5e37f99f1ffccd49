#include "features/watercolor/pigment/anchors_on_gpu.h"

#include <algorithm>
#include <bit>
#include <set>

#include "base/tileable_noise.h"
#include "scene/mesh_edges.h"
#include "scene/parallel.h"
#include "shading/frame.shared.h"
#include "world/geometry.h"

namespace scumble::watercolor {

namespace {

// Candidates of one mesh, the most and the least, and of all of a scene: where they are more, all meshes have
// fewer, and lose the finest of their anchors.
constexpr uint32_t kMost = 1u << 18, kFewest = 1024, kAltogether = 1u << 20;

bool isPainted(const GeometryItem& item) {
  return item.shown && item.primitive->indexCount() > 0 && !item.primitive->isPaint;
}

// Which mesh it is of: what the ground and features draw are meshes of their own.
using MeshKey = std::pair<int, const scene::Primitive*>;
MeshKey meshOf(const scene::SceneData& scene, const GeometryItem& item) {
  if (item.node == GeometryItem::kNoNode || item.feature >= 0) return {-1, item.primitive};
  return {scene.nodes[item.node].mesh, nullptr};
}

// What a node is called by, from its root on: of those that are called alike the second one is another.
// Whatever else comes into the scene changes none of them.
std::vector<uint32_t> nodeSeeds(const scene::SceneData& scene) {
  std::vector<uint32_t> seeds(scene.nodes.size());
  std::map<std::pair<uint32_t, std::string>, uint32_t> alike;
  for (size_t n = 0; n < scene.nodes.size(); ++n) {
    const scene::Node& node = scene.nodes[n];
    const uint32_t parent = node.parent >= 0 ? seeds[size_t(node.parent)] : 0;
    uint32_t seed = hash(parent + 1);
    for (const char c : node.name) seed = hash(seed ^ uint8_t(c));
    seeds[n] = hash(seed + alike[{parent, node.name}]++);
  }
  return seeds;
}

// Whether the primitives of a mesh, together, end nowhere.
bool areClosed(const std::vector<const scene::Primitive*>& primitives) {
  std::vector<std::vector<scene::MeshEdge>> edges;
  std::vector<const std::vector<scene::MeshEdge>*> lists;
  size_t open = 0;
  for (const scene::Primitive* primitive : primitives) edges.push_back(scene::edgesOf(*primitive));
  for (const std::vector<scene::MeshEdge>& list : edges) {
    lists.push_back(&list);
    for (const scene::MeshEdge& edge : list) open += edge.right == scene::MeshEdge::kNone;
  }
  return open == 0 || scene::sharedEdges(primitives, lists).size() * 2 == open;
}

}  // namespace

void AnchorsOnGpu::find(const scene::SceneData& scene, const std::vector<GeometryItem>& items) {
  std::map<MeshKey, std::vector<const scene::Primitive*>> meshes;
  const std::vector<uint32_t> ofNodes = nodeSeeds(scene);
  seeds_.assign(items.size(), 0);
  for (size_t i = 0; i < items.size(); ++i) {
    const GeometryItem& item = items[i];
    if (!isPainted(item)) continue;
    const bool isOfNode = item.node != GeometryItem::kNoNode;
    std::vector<const scene::Primitive*>& mesh = meshes[meshOf(scene, item)];
    const auto at = std::find(mesh.begin(), mesh.end(), item.primitive);
    seeds_[i] = hash((isOfNode ? ofNodes[item.node] : 0) ^
                     hash(uint32_t(at - mesh.begin()) + hash(uint32_t(item.instanceOfNode))));
    if (at == mesh.end()) mesh.push_back(item.primitive);
  }
  std::set<const scene::Primitive*> painted;
  for (const auto& [key, primitives] : meshes) painted.insert(primitives.begin(), primitives.end());
  std::erase_if(spreads_, [&](const auto& entry) { return !painted.contains(entry.first); });

  uint32_t most = kMost;
  while (most > kFewest && uint64_t(most) * meshes.size() > kAltogether) most /= 2;
  std::vector<std::pair<const scene::Primitive*, Spread*>> changed;
  for (const auto& [key, primitives] : meshes) {
    double whole = 0;
    bool isNew = false;
    for (const scene::Primitive* primitive : primitives) {
      const auto [spread, isAdded] = spreads_.try_emplace(primitive);
      if (isAdded) spread->second.area = scene::areaOf(*primitive);
      isNew |= isAdded;
      whole += spread->second.area;
    }
    const bool isDoubleSided = std::any_of(primitives.begin(), primitives.end(), [&](const auto* primitive) {
      return scene.materials[primitive->material].doubleSided;
    });
    const bool isClosed =
        isNew ? isDoubleSided && areClosed(primitives) : spreads_.at(primitives[0]).isClosed;
    for (const scene::Primitive* primitive : primitives) {
      Spread& spread = spreads_.at(primitive);
      spread.isClosed = isClosed;
      // In powers of two, so that small changes change nothing. The ground is one loose wash.
      const double share = most * spread.area / std::max(whole, 1e-30);
      const uint32_t candidates =
          key.second ? kFewest : std::bit_ceil(uint32_t(std::clamp<double>(share, kFewest, most)));
      // Whose vertices are gone keeps what it has.
      if (spread.candidates == candidates || primitive->positions.empty()) continue;
      spread.candidates = candidates;
      changed.push_back({primitive, &spread});
    }
  }
  isSided_.assign(items.size(), false);
  for (size_t i = 0; i < items.size(); ++i)
    if (const auto spread = spreads_.find(items[i].primitive); spread != spreads_.end())
      isSided_[i] = !scene.materials[items[i].primitive->material].doubleSided || spread->second.isClosed;
  scene::parallelFor(changed.size(), scene::threadCount(0), [&](size_t i) {
    const auto& [primitive, spread] = changed[i];
    // Where they lie is the mesh's own; what each is like follows from PaintedObject::seed.
    spread->anchors = scene::anchorsOf(*primitive, spread->candidates, 0);
  });
}

bool AnchorsOnGpu::update(gpu::Device& device, gpu::Uploader& uploader,
                          const std::vector<GeometryItem>& items, const std::vector<GeometryPlace>& places,
                          const std::function<void()>& settle) {
  std::vector<Known> known;
  for (size_t i = 0; i < items.size(); ++i) {
    const bool isShown = isPainted(items[i]);
    known.push_back({items[i].primitive, places[i].firstVertex,
                     isShown ? spreads_.at(items[i].primitive).candidates : 0, seeds_[i], items[i].material,
                     isShown, isSided_[i]});
  }
  if (anchors_.handle() && known == known_) return false;
  device.requireBindable(finalVertexCount(items, places) * sizeof(shared::VertexCore),
                         "a watercolour of so large a scene");
  known_ = std::move(known);

  std::vector<shared::DrawnAnchor> anchors;
  std::vector<shared::PaintedObject> objects;
  std::map<const scene::Primitive*, uint32_t> firstOf;
  painted_.clear();
  for (size_t i = 0; i < items.size(); ++i) {
    const Known& item = known_[i];
    if (!item.shown) continue;
    const Spread& spread = spreads_.at(item.primitive);
    const auto [first, isNew] = firstOf.try_emplace(item.primitive, uint32_t(anchors.size()));
    if (isNew)
      for (const scene::SurfaceAnchor& a : spread.anchors)
        anchors.push_back({a.a, a.b, a.c, a.toB, a.toC, a.spacing, a.area, a.seed});
    objects.push_back({first->second, item.firstVertex, uint32_t(i), item.seed, uint32_t(item.isSided)});
    painted_.push_back({uint32_t(i), item.material, &spread.anchors});
  }
  settle();
  // What was there goes first.
  anchors_ = {}, objects_ = {};
  anchors_ = uploader.storage<shared::DrawnAnchor>(anchors);
  objects_ = uploader.storage<shared::PaintedObject>(objects);
  return true;
}

}  // namespace scumble::watercolor
