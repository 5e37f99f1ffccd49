#include "features/ink/parts/parts_on_gpu.h"

#include <algorithm>
#include <set>

#include "features/ink/mesh_groups.h"
#include "scene/mesh_parts.h"
#include "scene/parallel.h"

namespace scumble::ink {

using namespace world;

void PartsOnGpu::find(const std::vector<GeometryItem>& items) {
  std::set<Mesh> used;
  std::vector<Mesh> missing;
  for (const MeshGroup& group : meshGroups(items)) {
    Mesh mesh = primitivesOf(items, group);
    if (used.insert(mesh).second && !partsOf_.contains(mesh)) missing.push_back(std::move(mesh));
  }
  std::erase_if(partsOf_, [&](const auto& entry) { return !used.contains(entry.first); });
  std::vector<std::vector<std::vector<uint32_t>>> found(missing.size());
  scene::parallelFor(missing.size(), scene::threadCount(0),
                     [&](size_t i) { found[i] = scene::partsOf(missing[i]); });
  for (size_t i = 0; i < missing.size(); ++i) partsOf_[missing[i]] = std::move(found[i]);
}

bool PartsOnGpu::update(gpu::Device& device, gpu::Uploader& uploader, const std::vector<GeometryItem>& items,
                        const std::vector<GeometryOnGpu::Place>& places,
                        const std::function<void()>& settle) {
  std::vector<Known> known;
  for (size_t i = 0; i < items.size(); ++i) known.push_back({items[i].primitive, places[i].firstVertex});
  if (parts_.handle() && known == known_) return false;
  const uint64_t vertices = finalVertexCount(items, places);
  device.requireBindable(vertices * sizeof(uint32_t), "lines of so large a scene");
  known_ = std::move(known);

  std::vector<uint32_t> parts(vertices, kOfNoMesh);
  uint64_t first = kOfNoMesh + 1;
  for (const MeshGroup& group : meshGroups(items)) {
    const auto& partsOfMesh = partsOf_.at(primitivesOf(items, group));
    uint32_t count = 0;
    for (size_t p = 0; p < group.size(); ++p) {
      for (size_t v = 0; v < partsOfMesh[p].size(); ++v) {
        parts[places[group[p]].firstVertex + v] = uint32_t((first + partsOfMesh[p][v]) % kMostParts);
        count = std::max(count, partsOfMesh[p][v] + 1);
      }
    }
    first += count;
  }
  settle();
  parts_ = {};  // what was there goes first
  parts_ = uploader.storage<uint32_t>(parts);
  return true;
}

}  // namespace scumble::ink
