// Surfaces that lie closely on one another: labels on things, clothes on bodies, eyes in heads.
#pragma once

#include "scene/scene_data.h"

namespace scumble::scene {

// Leaves out the levels of detail by which one surface would come through another one that lies along it, at
// rest: those that are off by more than a quarter of what is between the two, of both.
void keepLevelsApart(SceneData& scene);

}  // namespace scumble::scene
