// Worlds: JSON files that list scenes with their places (docs/scene.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scumble/scene.h"

namespace scumble::gltf {

constexpr size_t kMostScenes = 4096;  // of a world
constexpr size_t kMostWorlds = 8;     // within each other

// Loads a world; nothing where the file is none: it cannot be opened, or is a glTF by another name. `within`:
// the worlds that list it.
std::optional<Result<Scene>> loadWorld(const std::string& path, const SceneOptions& options,
                                       const std::vector<std::string>& within = {});

}  // namespace scumble::gltf
