#include "scene/clearance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/levels.h"

namespace scumble::scene {
namespace {

// A ball of so many cells, which has levels of detail.
Primitive ball(float radius, int cells) {
  Primitive p;
  for (int y = 0; y <= cells; ++y)
    for (int x = 0; x <= cells; ++x) {
      const float phi = 6.2831853f * float(x) / float(cells), theta = 3.1415926f * float(y) / float(cells);
      p.normals.emplace_back(std::sin(theta) * std::cos(phi), std::cos(theta),
                             std::sin(theta) * std::sin(phi));
      p.positions.push_back(radius * p.normals.back());
      p.uv0.emplace_back(float(x) / float(cells), float(y) / float(cells));
    }
  for (int y = 0; y < cells; ++y)
    for (int x = 0; x < cells; ++x) {
      const uint32_t i = uint32_t(y * (cells + 1) + x), up = i + uint32_t(cells) + 1;
      p.indices.insert(p.indices.end(), {i, up + 1, i + 1, i, up, up + 1});
    }
  p.smoothNormals = p.normals;
  makeLevels(p);
  return p;
}

// Each in a node of its own, at a place.
SceneData sceneOf(const std::vector<std::pair<Primitive, glm::vec3>>& parts) {
  SceneData scene;
  for (const auto& [primitive, place] : parts) {
    Node node;
    node.mesh = int(scene.meshes.size());
    node.local.translation = place;
    Mesh mesh;
    mesh.primitives.push_back(primitive);
    scene.meshes.emplace_back(std::move(mesh));
    scene.nodes.push_back(node);
  }
  keepLevelsApart(scene);
  return scene;
}
const Primitive& partOf(const SceneData& scene, size_t i) {
  const Mesh& mesh = scene.meshes[i];
  return mesh.primitives[0];
}

TEST(Clearance, whatLiesOnAnotherSurfaceIsLeftApart) {
  const Primitive alone = ball(1, 96);
  ASSERT_GE(alone.levels.size(), 3u);
  const float finest = alone.levels[0].shadowError;
  for (const float apart : {0.0f, 0.1f * finest, 2 * finest}) {
    const SceneData scene = sceneOf({{alone, {}}, {ball(1 + apart, 80), {}}});
    for (size_t i = 0; i < 2; ++i) {
      EXPECT_TRUE(partOf(scene, i).levels.empty()) << apart;
      EXPECT_TRUE(partOf(scene, i).levelIndices.empty());
    }
  }
  const SceneData scene = sceneOf({{alone, {}}, {ball(1.2f, 80), {}}});
  for (size_t i = 0; i < 2; ++i) {
    const Primitive& p = partOf(scene, i);
    ASSERT_FALSE(p.levels.empty()) << "fine ones may be drawn";
    for (const DetailLevel& level : p.levels) EXPECT_LT(level.shadowError, 0.1f);
    EXPECT_EQ(p.levelIndices.size(), p.levels.back().firstIndex + p.levels.back().indexCount);
  }
}

TEST(Clearance, whatLiesBesideAnotherKeepsItsLevels) {
  const Primitive alone = ball(1, 96);
  // Beside, far around, touching at a point, and passing through.
  for (const auto& [other, place] : {std::pair(ball(1, 96), glm::vec3(3, 0, 0)),
                                     {ball(4, 96), glm::vec3(0)},
                                     {ball(0.5f, 96), glm::vec3(1.5f, 0, 0)},
                                     {ball(1, 96), glm::vec3(1.2f, 0, 0)}}) {
    const SceneData scene = sceneOf({{alone, {}}, {other, place}});
    EXPECT_EQ(partOf(scene, 0).levels.size(), alone.levels.size()) << place.x;
    EXPECT_EQ(partOf(scene, 1).levels.size(), other.levels.size()) << place.x;
  }
}

// A sheet of so many cells, wavy so that its levels are off by something.
Primitive sheet(const glm::vec2& from, const glm::vec2& to, int cells, float height) {
  Primitive p;
  for (int y = 0; y <= cells; ++y)
    for (int x = 0; x <= cells; ++x) {
      const glm::vec2 at = glm::mix(from, to, glm::vec2(float(x), float(y)) / float(cells));
      p.positions.emplace_back(at.x, height + 0.02f * std::sin(9 * at.x) * std::sin(7 * at.y), at.y);
      p.normals.emplace_back(0, 1, 0);
      p.uv0.push_back(at);
    }
  for (int y = 0; y < cells; ++y)
    for (int x = 0; x < cells; ++x) {
      const uint32_t i = uint32_t(y * (cells + 1) + x), up = i + uint32_t(cells) + 1;
      p.indices.insert(p.indices.end(), {i, up + 1, i + 1, i, up, up + 1});
    }
  p.smoothNormals = p.normals;
  makeLevels(p);
  return p;
}

// Materials that go on where others end, as moss does on a stone: they have a border in common, and nothing
// lies on anything.
TEST(Clearance, whatGoesOnBesideKeepsItsLevels) {
  const Primitive large = sheet({-1, -1}, {1, 1}, 64, 0), small = sheet({1, -0.2f}, {1.3f, 0.1f}, 24, 0);
  ASSERT_GE(large.levels.size(), 2u);
  ASSERT_GE(small.levels.size(), 1u);
  const SceneData beside = sceneOf({{large, {}}, {small, {}}});
  EXPECT_EQ(partOf(beside, 0).levels.size(), large.levels.size());
  EXPECT_EQ(partOf(beside, 1).levels.size(), small.levels.size());
  // The same patch on top of it.
  const float finest = std::min(large.levels[0].shadowError, small.levels[0].shadowError);
  const SceneData above = sceneOf({{large, {}}, {sheet({0.2f, -0.2f}, {0.5f, 0.1f}, 24, finest), {}}});
  for (size_t i = 0; i < 2; ++i) EXPECT_TRUE(partOf(above, i).levels.empty()) << i;
}

// Clothes and the body in them bend together: where they rest is by their joints.
TEST(Clearance, whatBendsIsPlacedByItsJoints) {
  const auto skinned = [](Primitive p) {
    p.influences = 4;
    for (size_t v = 0; v < p.positions.size(); ++v) {
      p.joints.insert(p.joints.end(), {0, 0, 0, 0});
      p.weights.insert(p.weights.end(), {1, 0, 0, 0});
    }
    return p;
  };
  const Primitive body = skinned(ball(1, 96));
  const float apart = 2 * body.levels[0].shadowError;
  const Primitive coat = skinned(ball(1 + apart, 80));
  for (const bool isWorn : {true, false}) {
    SceneData scene;
    for (const Primitive* p : {&body, &coat}) {
      Mesh mesh;
      mesh.primitives.push_back(*p);
      Node node, joint;
      node.mesh = node.skin = int(scene.meshes.size());
      // Where the mesh's own node stands says nothing.
      node.local.translation = glm::vec3(7.0f * float(node.mesh), 0, 0);
      if (p == &coat && !isWorn) joint.local.translation = glm::vec3(5, 0, 0);
      scene.meshes.emplace_back(std::move(mesh));
      scene.nodes.push_back(node);
      scene.nodes.push_back(joint);
      scene.skins.push_back({"", {int(scene.nodes.size()) - 1}, {glm::mat4(1.0f)}});
    }
    keepLevelsApart(scene);
    for (size_t i = 0; i < 2; ++i) EXPECT_EQ(partOf(scene, i).levels.empty(), isWorn) << i;
  }
}

}  // namespace
}  // namespace scumble::scene
