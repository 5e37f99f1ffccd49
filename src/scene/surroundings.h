// What a scene's subjects stand on, which does not decide how they are framed.
#pragma once

#include <vector>

#include "scene/scene_data.h"

namespace scumble::scene {

// For each node: whether its mesh is low (Bounds::isLow) and far larger than all that is not, taken together
// with the low ones that are smaller. At rest; empty where there is nothing of the kind. Of low things alone,
// the smallest is a subject.
std::vector<bool> surroundings(const SceneData& scene);

}  // namespace scumble::scene
