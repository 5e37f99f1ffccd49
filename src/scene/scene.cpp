#include "scumble/scene.h"

#include <algorithm>

#include "scene/painting.h"
#include "scene/scene_data.h"
#include "scene/surroundings.h"

namespace scumble {

namespace {

using namespace scene;

const SceneData& emptyScene() {
  static const SceneData empty;
  return empty;
}

}  // namespace

const std::vector<std::string>& Scene::warnings() const {
  return data_ ? data_->warnings : emptyScene().warnings;
}

const std::vector<std::string>& Scene::files() const {
  return data_ ? data_->files : emptyScene().files;
}

const SceneTimings& Scene::timings() const {
  return timings_;
}

glm::dvec3 Scene::origin() const {
  return data_ ? data_->origin : glm::dvec3(0.0);
}

SceneSummary Scene::summary() const {
  const SceneData& data = data_ ? *data_ : emptyScene();
  SceneSummary s;
  s.meshes = data.meshes.size();
  s.nodes = data.nodes.size();
  s.materials = data.materials.size();
  s.images = data.images.size();
  s.skins = data.skins.size();
  for (const Mesh& mesh : data.meshes) {
    s.primitives += mesh.primitives.size();
    s.morphTargets += mesh.morphWeights.size();
    if (mesh.painting) {
      s.strokes += mesh.painting->strokes.size();
      s.points += mesh.painting->points.size();
      for (const std::string& brush : mesh.painting->brushes)
        if (std::find(s.brushes.begin(), s.brushes.end(), brush) == s.brushes.end())
          s.brushes.push_back(brush);
    }
    for (const Primitive& p : mesh.primitives) {
      s.triangles += p.indexCount() / 3;
      s.vertices += p.vertexCount();
      s.ownPatterns += p.generatedUvs || p.ownPattern;
    }
  }
  for (const Camera& camera : data.cameras) s.cameras.push_back(camera.name);
  for (const Light& light : data.lights) s.lights.push_back(light.name);
  // The first is glTF's default, which is in no file.
  for (size_t m = 1; m < data.materials.size(); ++m) s.materialNames.push_back(data.materials[m].name);
  for (const Node& node : data.nodes)
    if (!node.name.empty()) s.nodeNames.push_back(node.name);
  for (const Clip& clip : data.clips) s.clips.push_back({clip.name, clip.duration});
  s.extensionsUsed = data.extensionsUsed;
  s.extensionsNotSupported = data.extensionsNotSupported;
  for (int i = 0; i < 3; ++i) {
    s.min[i] = double(data.bounds.min[i]) + data.origin[i];
    s.max[i] = double(data.bounds.max[i]) + data.origin[i];
  }
  const std::vector<bool> around = surroundings(data);
  for (size_t n = 0; n < around.size(); ++n)
    if (around[n])
      s.surroundings.push_back(data.nodes[n].name.empty() ? std::to_string(n) : data.nodes[n].name);
  return s;
}

}  // namespace scumble
