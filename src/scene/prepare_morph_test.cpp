// What morph targets do to normals and tangents, at weight 1 where it is exact.
#include <gtest/gtest.h>

#include <cmath>

#include "scene/scene_data.h"
#include "scumble/scene.h"
#include "tests/support/loaded_test_gltf.h"

namespace scumble::scene {
namespace {

// The unit square, with one target that displaces its corners so.
Primitive morphedQuad(const std::vector<float>& displacements, const std::vector<float>& normals = {}) {
  TestGltf g;
  TestGltf::Json& primitive = g.addQuad();
  TestGltf::Json target = {{"POSITION", g.addFloats(displacements, 3)}};
  if (!normals.empty()) target["NORMAL"] = g.addFloats(normals, 3);
  primitive["targets"] = TestGltf::Json::array({target});
  return loaded(g).data().meshes[0]->primitives[0];
}

TEST(PrepareMorph, tangentsFollowTheStretch) {
  // Twice as wide, three times as high.
  const Primitive p = morphedQuad({0, 0, 0, 1, 0, 0, 1, 2, 0, 0, 2, 0});
  const MorphTarget& target = p.morphTargets[0];
  ASSERT_EQ(target.dPdu.size(), p.vertexCount());
  for (size_t v = 0; v < p.vertexCount(); ++v) {
    EXPECT_LT(glm::length(p.dPdu[v] + target.dPdu[v] - glm::vec3(2, 0, 0)), 1e-5f);
    EXPECT_LT(glm::length(p.dPdv[v] + target.dPdv[v] - glm::vec3(0, -3, 0)), 1e-5f);
  }
  EXPECT_TRUE(target.normals.empty());
  EXPECT_TRUE(target.smoothNormals.empty());
}

TEST(PrepareMorph, smoothNormalsTurnWithNormals) {
  const float s = std::sqrt(0.5f);
  std::vector<float> turned;
  for (int corner = 0; corner < 4; ++corner) turned.insert(turned.end(), {0, -s, s - 1});
  const Primitive p = morphedQuad(std::vector<float>(12, 0.0f), turned);
  const MorphTarget& target = p.morphTargets[0];
  ASSERT_EQ(target.smoothNormals.size(), p.vertexCount());
  for (size_t v = 0; v < p.vertexCount(); ++v)
    EXPECT_LT(glm::length(p.smoothNormals[v] + target.smoothNormals[v] - glm::vec3(0, -s, s)), 1e-5f);
}

// Two triangles without normals that fold along their common edge: each face turns by itself, the smooth
// normal of the edge stays shared and between both.
TEST(PrepareMorph, facesWithoutNormalsTurnWithTheirCorners) {
  TestGltf g;
  const int position = g.addFloats({0, -1, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0}, 3);
  TestGltf::Json& primitive = g.addMesh({{"POSITION", position}}, g.addIndices({0, 1, 2, 0, 2, 3}));
  primitive["targets"] =
      TestGltf::Json::array({{{"POSITION", g.addFloats({0, 0, 0, 0, 0, -1, 0, 0, 0, 0, 0, -1}, 3)}}});
  const Primitive p = loaded(g).data().meshes[0]->primitives[0];
  const MorphTarget& target = p.morphTargets[0];
  ASSERT_TRUE(p.generatedNormals);
  ASSERT_EQ(target.normals.size(), p.vertexCount());
  for (size_t v = 0; v < p.vertexCount(); ++v) {
    const float side = v < 3 ? 1.0f : -1.0f, s = std::sqrt(0.5f);
    EXPECT_LT(glm::length(p.normals[v] + target.normals[v] - glm::vec3(side * s, 0, s)), 1e-5f) << v;
    const glm::vec3 smooth = p.smoothNormals[v] + target.smoothNormals[v];
    EXPECT_NEAR(glm::length(smooth), 1, 1e-5f);
    const bool onTheEdge = p.positions[v].x == 0;
    EXPECT_TRUE(!onTheEdge || glm::length(smooth - glm::vec3(0, 0, 1)) < 1e-5f) << v;
  }
}

}  // namespace
}  // namespace scumble::scene
