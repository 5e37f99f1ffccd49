// What a SceneEditor is given, checked, as the scene's own data. Whatever makes no sense ends in an
// ImportFailure, whose path says which part it is about.
#pragma once

#include "scene/scene_data.h"
#include "scumble/scene_editor.h"

namespace scumble::scene {

template <class T>
bool isIndex(T id, size_t count) {
  return int(id) >= 0 && size_t(id) < count;
}

// Finite, and without a perspective.
bool isAffine(const glm::dmat4& m);

TextureImage imageOf(const TextureDesc& texture);
// `scene`: has the textures and materials that are named.
Material materialOf(const MaterialDesc& given, const SceneData& scene);
MaterialDesc descOf(const Material& material);
// `before`: the mesh that it takes the place of, if any.
Mesh meshOf(const std::vector<MeshPart>& parts, const SceneData& scene, const Mesh* before = nullptr);
Light lightOf(const LightDesc& given);

}  // namespace scumble::scene
