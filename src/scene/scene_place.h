// Scenes at their places in one world.
#pragma once

#include <memory>
#include <optional>

#include "scene/scene_data.h"
#include "scumble/scene.h"

namespace scumble::scene {

// What is wrong with a placement.
struct PlacementProblem {
  size_t scene = 0;    // which one
  std::string member;  // "at", "turn", "scale", "on"; empty: all of it
  std::string problem, advice;
};

// What would keep Scene::place from placing these, as far as it can be known before they are put together.
std::optional<PlacementProblem> problemWith(std::vector<PlacedScene> scenes);

// As Scene::place; null where something is wrong. Names are made different from each other in `scenes`.
std::shared_ptr<SceneData> placeScenes(std::vector<PlacedScene>& scenes, PlacementProblem& problem);

// Appends one scene to another, its nodes at `firstNode` of the list, which is long enough. What `shared`
// has been appended before, of the same data, is used again.
struct Appended {
  size_t images = 0, materials = 0, meshes = 0;
};
void appendScene(SceneData& all, const SceneData& one, size_t firstNode, const Appended* shared);

}  // namespace scumble::scene
