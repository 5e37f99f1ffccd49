// From scene nodes to what is drawn: one item for each primitive and instance, with a ground if there is to
// be one.
#pragma once

#include <deque>

#include "frame/scene_on_gpu.h"

namespace scumble::frame {

struct GeometryItem {
  const scene::Primitive* primitive;
  glm::mat4 model{1.0f};  // ignored where `skin` is set
  int skin = -1;
  uint32_t material = 0;
  uint32_t id = 0;       // whole number from 1, one a node
  bool casts = true;     // shadows
  scene::Bounds bounds;  // world
};

struct Geometry {
  std::vector<GeometryItem> items;
  std::deque<scene::Primitive> made;  // primitives that the scene does not have: subdivided ones, the ground
  std::vector<std::vector<glm::mat4>> joints;  // matrices of each skin
  scene::Bounds bounds;                        // without the ground
};

// `groundMaterial`: the material index of the ground, or -1 for none.
Geometry collectGeometry(const scene::SceneData& scene, const GeometryOptions& options, int groundMaterial);

// Longest edge, as a part of the shadow map's half width, that a sigmoid of this strength bends by less than
// a texel: an edge of length L strays from its curve by L^2 f'' / 8.
float longestEdge(float shadowWarp);

}  // namespace scumble::frame
