// What is baked: which paintings lie around which meshes.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/shared.h"
#include "scene/painting.h"
#include "scumble/bake.h"
#include "scumble/scene.h"

namespace scumble::bake {

struct Subjects {
  std::string path;  // of the glTF that is written anew; where there is a hull, nothing is
  std::vector<Shared<scene::Mesh>> meshes;  // of the scene, with their paintings; or the hull
  std::vector<std::string> materials;       // names
  bool isHull = false;
  std::optional<Scene> scene;  // that they are of
  std::vector<std::string> warnings;
};

// All strokes of a scene, in the world, as they stand at rest.
std::shared_ptr<const scene::Painting> paintingInWorld(const scene::SceneData& scene);

// The painting's own meshes; those of the proxy that options name, to each of which go the strokes that lie
// nearest to it; or where no mesh with strokes has a triangle, a hull.
Result<Subjects> findSubjects(const std::string& painting, const BakeOptions& options);

}  // namespace scumble::bake
