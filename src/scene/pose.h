// The scene in its rest pose: where joints are, and how large everything is.
#pragma once

#include "scene/scene_data.h"

namespace scumble::scene {

// For each skin, the matrices that take vertices from mesh space to the world: joint world x inverse bind.
std::vector<std::vector<glm::mat4>> jointMatrices(const SceneData& scene,
                                                  const std::vector<glm::mat4>& world);

// Position of vertex `v` in the world under a skin's matrices (linear blend skinning).
glm::vec3 skinnedPosition(const Primitive& primitive, size_t v, const std::vector<glm::mat4>& joints);

// World bounds of one primitive on a node, skinned or rigid, instances included.
Bounds posedBounds(const Primitive& primitive, const Node& node, const glm::mat4& nodeWorld,
                   const std::vector<std::vector<glm::mat4>>& joints);

}  // namespace scumble::scene
