// Rocks as if split with a chisel: a ball cut by random planes.
#pragma once

#include <functional>

#include "mesh_kit/mesh_builder.h"
#include "mesh_kit/random.h"

namespace demo {

struct RockShape {
  glm::vec3 center{0.0f}, halfSize{1.0f};
  float turn = 0.0f;  // radians around +Y
  float top = 1e9f;   // nothing rises above this height: a platform
  int levels = 3;     // how fine the ball is
  int cuts = 13;      // how many planes
  uint64_t seed = 1;
};

// Adds one; `paint` gives a face its material by normal and centre.
void addRock(meshkit::MeshBuilder& mesh, const RockShape& shape,
             const std::function<int(glm::vec3 normal, glm::vec3 center)>& paint);

}  // namespace demo
