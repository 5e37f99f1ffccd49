#include "features/ink/mesh_groups.h"

#include <map>
#include <utility>

namespace scumble::ink {

std::vector<MeshGroup> meshGroups(const std::vector<world::GeometryItem>& items) {
  std::vector<MeshGroup> groups;
  std::map<std::pair<size_t, size_t>, size_t> groupOf;  // by node and instance
  for (uint32_t i = 0; i < items.size(); ++i) {
    // The ground has no outline, nor has paint, and features draw their own.
    if (items[i].node == world::GeometryItem::kNoNode || items[i].primitive->isPaint) continue;
    const auto [found, isNew] = groupOf.try_emplace({items[i].node, items[i].instanceOfNode}, groups.size());
    if (isNew) groups.emplace_back();
    groups[found->second].push_back(i);
  }
  return groups;
}

std::vector<const scene::Primitive*> primitivesOf(const std::vector<world::GeometryItem>& items,
                                                  const MeshGroup& group) {
  std::vector<const scene::Primitive*> primitives;
  for (const uint32_t item : group) primitives.push_back(items[item].primitive);
  return primitives;
}

}  // namespace scumble::ink
