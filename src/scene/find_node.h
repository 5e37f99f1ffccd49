// Nodes by what users call them.
#pragma once

#include <string>

#include "scene/scene_data.h"

namespace scumble::scene {

// The first node of this name; where none has it and there is a '/', the first one called by what follows
// that and lying, however deep, below one called by what stands before it ("boat/Deck", "harbour/boat/Deck").
// -1: there is none.
int findNode(const SceneData& scene, const std::string& name);

}  // namespace scumble::scene
