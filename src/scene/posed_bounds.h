// How large things are in a pose.
#pragma once

#include <functional>

#include "scene/animation.h"

namespace scumble::scene {

// For each joint of a skin, the matrix that takes vertices from mesh space to the world: joint world x
// inverse bind.
std::vector<glm::mat4> jointMatrices(const Skin& skin, const std::vector<glm::dmat4>& world);

// Matrix from mesh space to the world of one instance of a node, multiplied in double precision; a node
// without instances has one, number 0.
size_t instanceCount(const Node& node);
glm::mat4 instanceToWorld(const Node& node, const glm::dmat4& world, size_t instance);
glm::mat4 instanceToWorld(const glm::dmat4& world, const glm::mat4& instance);

// Where a node puts its mesh at rest; of what joints place, about. `world`: worldMatrices().
glm::mat4 restPlaceOf(const SceneData& scene, const std::vector<glm::dmat4>& world, size_t node);

// Position of vertex `v` in the world under a skin's matrices (linear blend skinning); `position` is where
// the vertex is in mesh space.
glm::vec3 skinnedPosition(const Primitive& primitive, size_t v, const glm::vec3& position,
                          std::span<const glm::mat4> joints);

PrimitiveExtent extentOf(const Primitive& primitive);
// The same of some vertices alone, and of the triangles between them.
PrimitiveExtent extentOf(const Primitive& primitive, std::span<const uint32_t> vertices);

// A box around a primitive in the world, never too small: a skinned vertex lies between the places where its
// joints alone would put it. Empty where matrices leave it no area. `joints`: empty for what is not skinned,
// which `model` places.
Bounds posedBounds(const PrimitiveExtent& extent, const glm::mat4& model, std::span<const glm::mat4> joints,
                   std::span<const float> morphWeights);

// Numbers of all clips of a scene.
std::vector<int> allClips(const SceneData& scene);

// Poses from all over each of the clips, one clip at a time; without clips, the rest pose. `joints`: the
// jointMatrices() of each skin.
void forEachPose(
    const SceneData& scene, std::span<const int> clips,
    const std::function<void(const Pose&, std::span<const std::vector<glm::mat4>> joints)>& body);

// What the whole scene takes up while each of the clips plays, found at some times of it from the vertices
// themselves: close, and up to a little too small. Without clips: the scene's own bounds.
Bounds playedBounds(const SceneData& scene, std::span<const int> clips);

// The outermost ones of points, along so many directions that are spread over all sides; each once.
std::vector<glm::vec3> outermostOf(std::span<const glm::vec3> points, int directions);

// The outermost points of these nodes' meshes, world, at any time of these clips: of what bends, corners of
// its boxes. Empty where they have none.
std::vector<glm::vec3> playedOutline(const SceneData& scene, const std::vector<bool>& nodes,
                                     std::span<const int> clips);

}  // namespace scumble::scene
