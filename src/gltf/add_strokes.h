// A glTF written anew with strokes on its meshes, as one .glb.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/import_warnings.h"
#include "scene/painting.h"
#include "scumble/scene.h"

namespace scumble::gltf {

// `paintings`: by mesh of the scene that Scene::load makes of the file; null: none. All else is as it was,
// but that buffers and pictures in other files become part of it. Fails with scene::ImportFailure.
std::vector<uint8_t> withStrokes(const std::string& path, const SceneOptions& options,
                                 const scene::SceneData& scene,
                                 const std::vector<std::shared_ptr<const scene::Painting>>& paintings,
                                 scene::ImportWarnings& warnings);

}  // namespace scumble::gltf
