#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "gltf/import.h"
#include "scene/prepare_mesh.h"

namespace scumble::gltf {

namespace {

Skin readSkin(const Import& import, const Maps& maps, const JsonView& json) {
  Skin skin;
  skin.name = json.text("name");
  const JsonView joints = json.list("joints");
  if (joints.size() == 0) json.failAt("joints", "is missing or empty");
  import.budget.takeBytes(joints.size() * 68, json.path());
  for (size_t i = 0; i < joints.size(); ++i) {
    const int node = maps.nodes[joints.indexAt(i, maps.nodes.size(), "node")];
    if (node < 0) json.failAt("joints", "names a node that is not in the scene");
    skin.joints.push_back(node);
  }
  skin.inverseBindMatrices.assign(joints.size(), glm::mat4(1.0f));
  const int64_t index = json.index("inverseBindMatrices", import.accessors.count(), "accessor");
  if (index < 0) return skin;
  const Accessor accessor = import.accessors.open(index);
  if (accessor.components() != 16 || accessor.count < joints.size())
    json.failAt("inverseBindMatrices", "does not hold a matrix for every joint");
  import.budget.takeBytes(accessor.count * 64, accessor.path);
  std::vector<glm::mat4> matrices(accessor.count);
  readFloats(accessor, {}, 16, glm::value_ptr(matrices[0]));
  for (size_t i = 0; i < joints.size(); ++i) {
    for (int k = 0; k < 16; ++k)
      if (!(std::abs(glm::value_ptr(matrices[i])[k]) <= kMaxCoordinate))
        json.failAt("inverseBindMatrices", "holds a number that is not finite");
    skin.inverseBindMatrices[i] = matrices[i];
  }
  return skin;
}

size_t jointsNeeded(const Mesh& mesh) {
  size_t needed = 0;
  for (const Primitive& p : mesh.primitives)
    for (const uint16_t joint : p.joints) needed = std::max<size_t>(needed, joint + 1u);
  return needed;
}

}  // namespace

void readSkins(const Import& import, SceneData& scene, Maps& maps) {
  const JsonView list = import.document.list("skins");
  for (size_t i = 0; i < maps.skins.size(); ++i) {
    if (maps.skins[i] < 0) continue;
    maps.skins[i] = -1;
    try {
      scene.skins.push_back(readSkin(import, maps, list.at(i)));
      maps.skins[i] = static_cast<int>(scene.skins.size()) - 1;
    } catch (const ImportFailure& failure) {
      warnIgnored(import.warnings, failure, "a skin is");
    }
  }
  std::vector<size_t> needed(scene.meshes.size());
  for (size_t i = 0; i < needed.size(); ++i) needed[i] = jointsNeeded(scene.meshes[i]);
  for (Node& node : scene.nodes) {
    if (node.skin < 0) continue;
    node.skin = maps.skins[node.skin];
    if (node.skin < 0) continue;
    const size_t joints = scene.skins[node.skin].joints.size();
    if (needed[node.mesh] > joints) {
      import.warnings.add("nodes", "a skin is ignored: its mesh asks for joint " +
                                       std::to_string(needed[node.mesh] - 1) + " of " +
                                       std::to_string(joints));
      node.skin = -1;
    } else if (needed[node.mesh] == 0) {
      node.skin = -1;  // nothing in the mesh follows it
    }
  }
}

}  // namespace scumble::gltf
