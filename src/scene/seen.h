// Parts of a scene that can be seen. Framing, bounds, ground, shadows, lines, mattes and drawings all ask
// here: what is not seen is not there for any of them.
//
// A surface is not seen where its node, or one above it, is hidden; where a matrix leaves it no area (scale
// 0); and where its material is transparent or cut away (alpha of material, vertices and texture together).
#pragma once

#include <span>

#include "scene/scene_data.h"

namespace scumble::scene {

// True where a matrix leaves surfaces any area; false for scales of 0 along two or three axes.
bool keepsArea(const glm::mat4& matrix);

// By node: whether it and all nodes above it are visible at rest.
std::vector<bool> shownNodes(const SceneData& scene);

// By node: the same at rest or at some time of a clip.
std::vector<bool> everShownNodes(const SceneData& scene);

// Alpha of a primitive's surface: of its material, its vertices and its texture together. All of them stay.
class SurfaceAlpha {
 public:
  SurfaceAlpha(const SceneData& scene, const Primitive& primitive);
  // True where it is 1, or does not count, everywhere.
  bool isWhole() const { return isWhole_; }
  // At a place of a triangle: weights of its corners.
  float at(const glm::uvec3& corners, const glm::vec3& weights) const;
  // Texels from one place to another; 0 without a texture.
  float texelsBetween(uint32_t vertex, uint32_t other) const;
  // Below it nothing is drawn.
  float least() const;

 private:
  const Primitive& primitive_;
  const Material& material_;
  const TextureImage* image_ = nullptr;
  const std::vector<glm::vec2>& uvs_;
  bool isWhole_ = true;
};

// Fills SceneData::seen from materials, vertex colours and textures.
void findSeen(SceneData& scene);

// Part of a mesh's primitive `p` that is seen: all of it in scenes for which findSeen() was not called.
const SeenPart& seenOf(const SceneData& scene, int mesh, size_t p);

// The extent of what is seen of it.
const PrimitiveExtent& seenExtent(const SceneData& scene, int mesh, size_t p);

// By node: whether anything of its mesh, or a stroke on it, is seen at rest or at some time of these clips.
std::vector<bool> seenNodes(const SceneData& scene, std::span<const int> clips);

}  // namespace scumble::scene
