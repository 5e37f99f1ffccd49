// Pieces of meshes, by what joins them.
#include "scene/mesh_parts.h"

#include <gtest/gtest.h>

namespace scumble::scene {
namespace {

using Numbers = std::vector<uint32_t>;

// A square in the plane at a height, of vertices of its own for each triangle.
void addSquare(Primitive& mesh, float x, float height) {
  for (const glm::vec2& corner : {glm::vec2(0, 0), {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}) {
    mesh.indices.push_back(uint32_t(mesh.positions.size()));
    mesh.positions.emplace_back(x + corner.x, corner.y, height);
  }
}

TEST(MeshParts, areWhatTrianglesJoin) {
  Primitive mesh;
  addSquare(mesh, 0, 0);
  addSquare(mesh, 0, 1);
  addSquare(mesh, 1, 0);  // beside the first
  const Primitive* const one[] = {&mesh};
  EXPECT_EQ(partsOf(one), (std::vector<Numbers>{{0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0}}));
}

TEST(MeshParts, goOnFromPrimitiveToPrimitive) {
  Primitive left, right;
  addSquare(left, 0, 0);
  addSquare(right, 3, 5);
  addSquare(right, 1, 0);
  const Primitive* const both[] = {&left, &right};
  EXPECT_EQ(partsOf(both), (std::vector<Numbers>{Numbers(6, 0), {1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0}}));
}

TEST(MeshParts, whatHasNoTrianglesIsAPieceAPlace) {
  Primitive mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}};
  Primitive none;
  const Primitive* const both[] = {&none, &mesh};
  EXPECT_EQ(partsOf(both), (std::vector<Numbers>{{}, {0, 1, 0}}));
}

}  // namespace
}  // namespace scumble::scene
