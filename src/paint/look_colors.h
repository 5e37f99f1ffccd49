// The colours that a look gives to a scene, from pictures all around it.
#pragma once

#include <array>
#include <optional>
#include <unordered_map>
#include <vector>

#include "scene/scene_data.h"
#include "scumble/renderer.h"

namespace scumble::paint {

// The vertices of a mesh where a node has them at rest, world; by primitive.
struct PosedMesh {
  std::vector<std::vector<glm::vec3>> positions, normals;
};
PosedMesh posedAtRest(const scene::SceneData& scene, size_t node);

class LookColors {
 public:
  // Draws the scene at rest, without a ground and torn edges; strokes that it has already are seen. Fails
  // as rendering does.
  static Result<LookColors> make(Renderer& renderer, const Scene& scene, const Look& look);

  // Square root of the colour of what is seen there, of a surface that faces so; nothing where no picture
  // shows it.
  std::optional<glm::vec3> rootAt(const glm::vec3& world, const glm::vec3& normal) const;

 private:
  using Cell = std::array<int, 4>;  // x, y, z, and which way it faces
  struct Hash {
    size_t operator()(const Cell& cell) const;
  };
  Cell cellOf(const glm::vec3& world, const glm::vec3& normal) const;

  float cellSize_ = 1;                               // metres
  std::unordered_map<Cell, glm::vec4, Hash> cells_;  // sums of square roots; A: of how many
};

}  // namespace scumble::paint
