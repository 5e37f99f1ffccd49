// What rides the ocean's waves.
#pragma once

#include <vector>

#include "look/look_data.h"
#include "scene/scene_data.h"

namespace scumble::ocean {

#define PARAMS_STRUCT FloatParams
#define PARAMS_FILE "features/ocean/float.params"
#define PARAMS_PATH "float"
#define PARAMS_TARGETS look::kNodes
#include "look/define_params.h"

// FloatParams::hull.
constexpr int kHullAuto = 0, kHullWhole = 1, kHullInside = 2, kHullOff = 3;

struct FloatingNode {
  size_t node;
  FloatParams params;
};

// The nodes that ride by themselves, not since one above them does: those of which the look says so, or else
// the scene (docs/sea.md). `ocean`: the ocean's own node, which does not; -1: none.
std::vector<FloatingNode> floatingNodes(const scene::SceneData& scene, const look::LookData& look, int ocean);

}  // namespace scumble::ocean
