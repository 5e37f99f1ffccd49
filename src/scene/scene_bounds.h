// Where everything is in the rest pose.
#pragma once

#include "scene/import_warnings.h"
#include "scene/scene_data.h"

namespace scumble::scene {

// Sets SceneData::origin: a place near most of what is drawn, (0, 0, 0) where that lies near enough.
void findOrigin(SceneData& scene);

// Fills SceneData::origin and SceneData::seen, and SceneData::bounds from it. What lies so far out that it
// could not be drawn is taken off its node with a warning; fails when a transformation is not finite, or more
// is drawn than any machine could.
void placeScene(SceneData& scene, ImportWarnings& warnings);

// Fails where there is nothing to draw.
void requireMeshes(const SceneData& scene);

}  // namespace scumble::scene
