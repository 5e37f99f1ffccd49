#include "stage/node_settings.h"

#include <algorithm>
#include <map>

#include "stage/animation_params.h"

namespace scumble::stage {

NodeSettings nodeSettings(const scene::SceneData& scene, const look::LookData& look) {
  NodeSettings settings;
  // How long poses stand is no matter of materials (playing.h).
  std::vector<uint32_t> candidates;
  for (size_t i = 0; i < look.assignments.size(); ++i)
    if (look.assignments[i].target == look::kNodes && look.assignments[i].block != &AnimationParams::block())
      candidates.push_back(uint32_t(i));
  if (candidates.empty()) return settings;

  std::map<std::vector<uint32_t>, uint32_t> known{{{}, 0}};
  for (const scene::Node& node : scene.nodes) {
    const uint32_t above = node.parent >= 0 ? settings.ofNode[size_t(node.parent)] : 0;
    std::vector<uint32_t> own;
    for (const uint32_t place : candidates)
      if (look::matches(look.assignments[place].pattern, node.name)) own.push_back(place);
    if (own.empty()) {
      settings.ofNode.push_back(above);
      continue;
    }
    std::vector<uint32_t> all;
    for (const uint32_t place : settings.lists[above])
      if (std::find(own.begin(), own.end(), place) == own.end()) all.push_back(place);
    all.insert(all.end(), own.begin(), own.end());
    const auto [list, isNew] = known.try_emplace(all, uint32_t(settings.lists.size()));
    if (isNew) settings.lists.push_back(all);
    settings.ofNode.push_back(list->second);
  }
  return settings;
}

}  // namespace scumble::stage
