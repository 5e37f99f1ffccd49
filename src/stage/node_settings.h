// What a look sets for nodes, as far as it goes into what they are drawn with: draws of one material on nodes
// with different settings need material data of their own.
#pragma once

#include <cstdint>
#include <vector>

#include "look/look_data.h"
#include "scene/scene_data.h"

namespace scumble::stage {

struct NodeSettings {
  // Lists of settings by their places in LookData::assignments, the later ones winning; the first is empty.
  std::vector<std::vector<uint32_t>> lists{{}};
  std::vector<uint32_t> ofNode;  // by node: which list; empty: the look sets nothing for nodes
  bool operator==(const NodeSettings&) const = default;
};

// A node has its own settings over those of the nodes above it. They do not depend on time, though their
// values may.
NodeSettings nodeSettings(const scene::SceneData& scene, const look::LookData& look);

}  // namespace scumble::stage
