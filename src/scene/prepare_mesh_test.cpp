// Properties of prepared meshes: normals, generated texture coordinates, tangent vectors.
#include "scene/prepare_mesh.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "scumble/scene.h"
#include "tests/support/loaded_test_gltf.h"

namespace scumble::scene {
namespace {

// A cube of eight vertices, without normals or texture coordinates.
TestGltf cube(float scale = 1.0f) {
  TestGltf g;
  std::vector<float> p;
  for (int i = 0; i < 8; ++i)
    for (const int bit : {1, 2, 4}) p.push_back((i & bit ? 1.0f : -1.0f) * scale);
  g.addMesh({{"POSITION", g.addFloats(p, 3)}},
            g.addIndices({0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                          2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5}));
  return g;
}

TEST(PrepareMesh, quadHasExactTangents) {
  TestGltf g;
  g.addQuad();
  const Scene scene = loaded(g);
  const Primitive& p = scene.data().meshes[0]->primitives[0];
  for (size_t i = 0; i < p.vertexCount(); ++i) {
    EXPECT_LT(glm::length(p.dPdu[i] - glm::vec3(1, 0, 0)), 1e-6f);
    EXPECT_LT(glm::length(p.dPdv[i] - glm::vec3(0, -1, 0)), 1e-6f);
  }
}

TEST(PrepareMesh, tangentsScaleWithTheMapping) {
  TestGltf g;
  const int position = g.addFloats({0, 0, 0, 4, 0, 0, 4, 0, -2, 0, 0, -2}, 3);
  const int uv = g.addFloats({0, 0, 0.5f, 0, 0.5f, 8, 0, 8}, 2);
  g.addMesh({{"POSITION", position}, {"TEXCOORD_0", uv}}, g.addIndices({0, 1, 2, 0, 2, 3}));
  const Scene scene = loaded(g);
  const Primitive& p = scene.data().meshes[0]->primitives[0];
  ASSERT_EQ(p.vertexCount(), 6u);  // flat: every corner its own
  for (size_t i = 0; i < p.vertexCount(); ++i) {
    EXPECT_LT(glm::length(p.dPdu[i] - glm::vec3(8, 0, 0)), 1e-5f);
    EXPECT_LT(glm::length(p.dPdv[i] - glm::vec3(0, 0, -0.25f)), 1e-6f);
  }
}

// A strip mirrored about x = 0, sharing the vertices there.
TEST(PrepareMesh, mirroredMappingKeepsItsLengthAtTheSeam) {
  TestGltf g;
  const int position = g.addFloats({-1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 1, 0, 0, 1, 0, 1, 1, 0}, 3);
  const int uv = g.addFloats({1, 0, 0, 0, 1, 0, 1, 1, 0, 1, 1, 1}, 2);
  const int normal = g.addFloats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
  g.addMesh({{"POSITION", position}, {"TEXCOORD_0", uv}, {"NORMAL", normal}},
            g.addIndices({0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4}));
  const Scene scene = loaded(g);
  for (const glm::vec3& dPdu : scene.data().meshes[0]->primitives[0].dPdu)
    EXPECT_NEAR(glm::length(dPdu), 1.0f, 1e-5f);
}

TEST(PrepareMesh, degenerateMappingGetsCoordinatesForPatterns) {
  TestGltf g;
  const int position = g.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3), uv = g.addFloats({0, 0, 1, 1, 2, 2}, 2);
  g.addMesh({{"POSITION", position}, {"TEXCOORD_0", uv}});
  const Scene scene = loaded(g);
  const Primitive& p = scene.data().meshes[0]->primitives[0];
  ASSERT_EQ(p.patternUv.size(), p.vertexCount());
  EXPECT_EQ(p.uv0[2], glm::vec2(2, 2)) << "the file's own coordinates stay for its textures";
  for (size_t v = 0; v < p.vertexCount(); ++v)
    EXPECT_GT(glm::length(glm::cross(p.dPdu[v], p.dPdv[v])), 0.0f) << "they spread the surface out";
}

TEST(PrepareMesh, missingNormalsAreFlatAndSmoothNormalsShared) {
  const Scene scene = loaded(cube());
  const Primitive& p = scene.data().meshes[0]->primitives[0];
  EXPECT_TRUE(p.generatedNormals);
  ASSERT_EQ(p.vertexCount(), 36u);
  for (size_t i = 0; i < p.vertexCount(); ++i) {
    const glm::vec3 n = glm::abs(p.normals[i]);
    EXPECT_NEAR(std::max({n.x, n.y, n.z}), 1.0f, 1e-6f);
    EXPECT_GT(glm::dot(p.normals[i], p.positions[i]), 0.0f);
    // Angle weights make the corner of a cube symmetric, however its faces are cut into triangles.
    EXPECT_LT(glm::length(p.smoothNormals[i] - glm::normalize(p.positions[i])), 1e-3f);
  }
}

// A corner of 120 degrees, the first of its triangle or the second, and one of 90: their angles are the
// weights.
TEST(PrepareMesh, obtuseCornersWeighWhatTheyAre) {
  const float s = 0.8660254f;
  for (const std::vector<uint16_t>& obtuse :
       {std::vector<uint16_t>{0, 1, 2}, std::vector<uint16_t>{2, 0, 1}, std::vector<uint16_t>{1, 2, 0}}) {
    TestGltf g;
    const int position = g.addFloats({0, 0, 0, 1, 0, 0, -0.5f, s, 0, 0, 0, 1}, 3);
    std::vector<uint16_t> indices = {0, 3, 1};
    indices.insert(indices.end(), obtuse.begin(), obtuse.end());
    g.addMesh({{"POSITION", position}}, g.addIndices(indices));
    const Scene scene = loaded(g);
    const Primitive& p = scene.data().meshes[0]->primitives[0];
    // 120 degrees of +z and 90 of +y.
    const glm::dvec3 expected = glm::normalize(glm::dvec3(0, 90, 120));
    int seen = 0;
    for (size_t i = 0; i < p.vertexCount(); ++i) {
      if (p.positions[i] != glm::vec3(0.0f)) continue;
      EXPECT_LT(glm::length(glm::dvec3(p.smoothNormals[i]) - expected), 1e-3);
      ++seen;
    }
    EXPECT_EQ(seen, 2);
  }
}

TEST(PrepareMesh, smoothNormalsAreSharedBetweenPrimitives) {
  TestGltf g;
  const int a = g.addFloats({0, 0, 0, 1, 0, 0, 0, 0, -1}, 3),
            b = g.addFloats({0, 0, 0, 0, -1, 0, 1, 0, 0}, 3);
  g.addMesh({{"POSITION", a}});
  g.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", b}}}});
  const Scene scene = loaded(g);
  const Mesh& mesh = scene.data().meshes[0];
  ASSERT_EQ(mesh.primitives.size(), 2u);
  for (const glm::vec3& shared : {glm::vec3(0, 0, 0), glm::vec3(1, 0, 0)}) {
    std::vector<glm::vec3> found;
    for (const Primitive& p : mesh.primitives)
      for (size_t i = 0; i < p.vertexCount(); ++i)
        if (p.positions[i] == shared) found.push_back(p.smoothNormals[i]);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0], found[1]);
    EXPECT_NEAR(std::abs(found[0].y), std::abs(found[0].z), 1e-3f);
  }
}

// A cube's faces lie as they are; half of its diagonal is one unit.
TEST(PrepareMesh, generatedUvsAreScaleFree) {
  for (const float scale : {1.0f, 1e-6f, 1e6f}) {
    const Scene scene = loaded(cube(scale));
    const Primitive& p = scene.data().meshes[0]->primitives[0];
    EXPECT_TRUE(p.generatedUvs);
    const Bounds box = boxOf(p.positions);
    for (size_t i = 0; i < p.indices.size(); ++i) {
      const uint32_t v = p.indices[i], w = p.indices[i - i % 3 + (i + 1) % 3];
      EXPECT_NEAR(glm::distance(p.uv0[v], p.uv0[w]),
                  glm::distance(p.positions[v], p.positions[w]) / box.radius(), 1e-4f);
    }
  }
}

TEST(PrepareMesh, brokenNormalsAreMended) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  TestGltf g;
  const int position = g.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, 3);
  const int normal = g.addFloats({nan, 0, 0, 0, 0, 0, 0, inf, 0, 0, 0, 7}, 3);
  g.addMesh({{"POSITION", position}, {"NORMAL", normal}}, g.addIndices({0, 1, 2, 2, 1, 3}));
  const Scene scene = loaded(g);
  for (const glm::vec3& n : scene.data().meshes[0]->primitives[0].normals)
    EXPECT_LT(glm::length(n - glm::vec3(0, 0, 1)), 1e-5f);
  EXPECT_EQ(scene.warnings().size(), 1u);
}

TEST(PrepareMesh, undrawableTrianglesAreLeftOut) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  TestGltf g;
  const int position = g.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0, nan, 0, 0, 1e30f, 1, 1, 9, 9, 9}, 3);
  const int normal = g.addFloats(std::vector<float>(18, 0.57735f), 3);
  g.addMesh({{"POSITION", position}, {"NORMAL", normal}},
            g.addIndices({0, 1, 2, 0, 1, 3, 1, 2, 4, 5, 5, 5, 0, 1, 1}));
  const Scene scene = loaded(g);
  EXPECT_EQ(scene.summary().triangles, 1u);
  EXPECT_EQ(scene.summary().vertices, 3u);
  EXPECT_LE(scene.summary().max[0], 1.0);
  EXPECT_EQ(scene.warnings().size(), 1u);
}

// A ball as modellers make it, with two poles and a seam whose sides were computed: the mapping closes on
// itself along u, and both sides of the seam have the same tangents and smooth normals, whether corners share
// vertices or none do.
// A cone whose tip is split for each triangle. Comparing each of its vertices with each took minutes.
TEST(PrepareMesh, manyCoordinatesAtOnePlaceTakeNoTime) {
  constexpr int kTriangles = 200'000;
  std::vector<float> positions, uvs, normals;
  for (int i = 0; i < kTriangles; ++i) {
    const float angle = 6.2831853f * float(i) / kTriangles, next = 6.2831853f * float(i + 1) / kTriangles;
    positions.insert(positions.end(),
                     {0, 1, 0, std::cos(angle), 0, std::sin(angle), std::cos(next), 0, std::sin(next)});
    uvs.insert(uvs.end(), {float(i), 0, float(i), 1, float(i + 1), 1});
    for (int corner = 0; corner < 3; ++corner) normals.insert(normals.end(), {0, 1, 0});
  }
  TestGltf g;
  const int position = g.addFloats(positions, 3), uv = g.addFloats(uvs, 2), normal = g.addFloats(normals, 3);
  g.addMesh({{"POSITION", position}, {"TEXCOORD_0", uv}, {"NORMAL", normal}}, -1);
  const auto begin = std::chrono::steady_clock::now();
  const Scene scene = loaded(g);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 20);
  EXPECT_EQ(scene.data().meshes[0]->primitives[0].indices.size(), 3u * kTriangles);
}

TEST(PrepareMesh, aBallClosesOnItself) {
  constexpr int kColumns = 24, kRows = 12;
  for (const bool shares : {true, false}) {
    std::vector<float> position, normal, uv;
    std::vector<uint16_t> indices;
    for (int row = 0; row <= kRows; ++row)
      for (int column = 0; column <= kColumns; ++column) {
        const float u = float(column) / kColumns, v = float(row) / kRows;
        const float a = 6.2831853f * u, b = 3.14159265f * v;
        const float p[3] = {std::sin(b) * std::cos(a), std::cos(b), -std::sin(b) * std::sin(a)};
        position.insert(position.end(), p, p + 3);
        normal.insert(normal.end(), p, p + 3);
        uv.insert(uv.end(), {u, v});
      }
    for (int row = 0; row < kRows; ++row)
      for (int column = 0; column < kColumns; ++column) {
        const uint16_t i = uint16_t(row * (kColumns + 1) + column), j = uint16_t(i + kColumns + 1);
        for (const int k : {int(i), int(j), j + 1, int(i), j + 1, i + 1}) indices.push_back(uint16_t(k));
      }
    if (!shares) {
      const auto split = [&](std::vector<float>& values, size_t n) {
        std::vector<float> corners;
        for (const uint16_t i : indices) corners.insert(corners.end(), &values[i * n], &values[i * n] + n);
        values = corners;
      };
      split(position, 3), split(normal, 3), split(uv, 2);
    }
    TestGltf g;
    const TestGltf::Json attributes = {{"POSITION", g.addFloats(position, 3)},
                                       {"NORMAL", g.addFloats(normal, 3)},
                                       {"TEXCOORD_0", g.addFloats(uv, 2)}};
    g.addMesh(attributes, shares ? g.addIndices(indices) : -1);
    const Scene scene = loaded(g);
    const Primitive& p = scene.data().meshes[0]->primitives[0];
    EXPECT_TRUE(p.wrapsU);
    EXPECT_FALSE(p.wrapsV);
    // One tangent at each place between the poles.
    std::map<std::pair<int, int>, size_t> first;
    for (size_t v = 0; v < p.vertexCount(); ++v) {
      const int row = int(std::lround(p.uv0[v].y * kRows)),
                column = int(std::lround(p.uv0[v].x * kColumns)) % kColumns;
      if (row == 0 || row == kRows) continue;
      const size_t other = first.try_emplace({row, column}, v).first->second;
      EXPECT_LT(glm::length(p.dPdu[v] - p.dPdu[other]), 1e-4f) << row << ", " << column;
      EXPECT_LT(glm::length(p.dPdv[v] - p.dPdv[other]), 1e-4f) << row << ", " << column;
      EXPECT_LT(glm::length(p.smoothNormals[v] - p.smoothNormals[other]), 1e-5f) << row << ", " << column;
    }
    EXPECT_EQ(first.size(), size_t((kRows - 1) * kColumns));
  }
}

}  // namespace
}  // namespace scumble::scene
