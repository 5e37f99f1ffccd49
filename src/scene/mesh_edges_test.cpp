// Edges: each once, with what lies on both sides, whatever splits vertices; what is broken in a mesh counts
// for nothing or ends there.
#include "scene/mesh_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <random>

namespace scumble::scene {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

// Vertices as triangles share them, or (split) one for each corner.
Primitive meshOf(const std::vector<glm::vec3>& points, const Triangles& triangles, bool split) {
  Primitive mesh;
  if (!split) mesh.positions = points;
  for (const auto& triangle : triangles)
    for (const int corner : triangle) {
      if (split) mesh.positions.push_back(points[size_t(corner)]);
      mesh.indices.push_back(split ? uint32_t(mesh.indices.size()) : uint32_t(corner));
    }
  return mesh;
}

const std::vector<glm::vec3> kCube{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                   {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const Triangles kCubeSides{{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                           {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};

size_t openOnes(const std::vector<MeshEdge>& edges) {
  return size_t(std::count_if(edges.begin(), edges.end(),
                              [](const MeshEdge& edge) { return edge.right == MeshEdge::kNone; }));
}

class MeshEdgesOf : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Vertices, MeshEdgesOf, testing::Bool(),
                         [](const auto& test) { return test.param ? "splitAtEachCorner" : "shared"; });

TEST_P(MeshEdgesOf, aCubeHasEighteenAndNoEnds) {
  const Primitive cube = meshOf(kCube, kCubeSides, GetParam());
  const std::vector<MeshEdge> edges = edgesOf(cube);
  EXPECT_EQ(edges.size(), 18u);
  EXPECT_EQ(openOnes(edges), 0u);
  for (const MeshEdge& edge : edges) {
    // Normals of both sides, as the header says how they are wound, point outwards.
    const auto& p = cube.positions;
    const glm::vec3 along = p[edge.b] - p[edge.a], middle(0.5f);
    const glm::vec3 left = glm::cross(along, p[edge.left] - p[edge.a]),
                    right = glm::cross(p[edge.right] - p[edge.a], along);
    EXPECT_GT(glm::dot(left, p[edge.a] - middle), 0);
    EXPECT_GT(glm::dot(right, p[edge.a] - middle), 0);
  }
}

TEST_P(MeshEdgesOf, whatIsMissingLeavesEnds) {
  const Triangles open(kCubeSides.begin() + 1, kCubeSides.end());
  const std::vector<MeshEdge> edges = edgesOf(meshOf(kCube, open, GetParam()));
  EXPECT_EQ(edges.size(), 18u);
  EXPECT_EQ(openOnes(edges), 3u);
}

// Beyond both sides of an edge, against a search among all triangles.
TEST_P(MeshEdgesOf, knowWhatLiesBeyondTheirTriangles) {
  // A side of the cube is missing.
  const Triangles open(kCubeSides.begin() + 1, kCubeSides.end());
  const Primitive mesh = meshOf(kCube, open, GetParam());
  const auto& p = mesh.positions;
  const auto& t = mesh.indices;
  // The third place of the triangle that goes from one place to another.
  const auto thirdOf = [&](const glm::vec3& from, const glm::vec3& to) -> std::optional<glm::vec3> {
    for (size_t corner = 0; corner < t.size(); ++corner) {
      const size_t first = corner - corner % 3;
      if (p[t[corner]] == from && p[t[first + (corner + 1) % 3]] == to) return p[t[first + (corner + 2) % 3]];
    }
    return std::nullopt;
  };
  int none = 0;
  for (const MeshEdge& edge : edgesOf(mesh)) {
    const uint32_t ends[4][2] = {
        {edge.b, edge.left}, {edge.left, edge.a}, {edge.a, edge.right}, {edge.right, edge.b}};
    for (int i = 0; i < 4; ++i) {
      std::optional<glm::vec3> expected;
      if (ends[i][0] != MeshEdge::kNone && ends[i][1] != MeshEdge::kNone)
        expected = thirdOf(p[ends[i][1]], p[ends[i][0]]);
      ASSERT_EQ(edge.beyond[size_t(i)] == MeshEdge::kNone, !expected);
      if (expected)
        EXPECT_EQ(p[edge.beyond[size_t(i)]], *expected);
      else
        ++none;
    }
  }
  EXPECT_GE(none, 3 * 2);
}

TEST_P(MeshEdgesOf, doubledAndFlatTrianglesCountForNothing) {
  Triangles triangles = kCubeSides;
  triangles.push_back({0, 2, 1});  // once more
  triangles.push_back({1, 2, 0});  // from behind
  triangles.push_back({3, 3, 5});
  triangles.push_back({6, 2, 6});
  const auto plain = edgesOf(meshOf(kCube, kCubeSides, GetParam())),
             more = edgesOf(meshOf(kCube, triangles, GetParam()));
  EXPECT_EQ(more.size(), plain.size());
  EXPECT_EQ(openOnes(more), 0u);
}

TEST_P(MeshEdgesOf, whereThreeMeetTwoArePairedAndOneEnds) {
  // A fin that stands on an edge of the cube.
  std::vector<glm::vec3> points = kCube;
  points.push_back({0.5f, -1, -1});
  Triangles triangles = kCubeSides;
  triangles.push_back({0, 1, 8});
  const std::vector<MeshEdge> edges = edgesOf(meshOf(points, triangles, GetParam()));
  EXPECT_EQ(edges.size(), 18u + 3u);
  EXPECT_EQ(openOnes(edges), 3u);
}

TEST_P(MeshEdgesOf, twoThatAreWoundAlikeBothEnd) {
  const std::vector<glm::vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  EXPECT_EQ(openOnes(edgesOf(meshOf(points, {{0, 1, 2}, {1, 0, 3}}, GetParam()))), 4u);
  EXPECT_EQ(openOnes(edgesOf(meshOf(points, {{0, 1, 2}, {0, 1, 3}}, GetParam()))), 6u);
}

// By brute force: how many triangles have each pair of places, in a mesh of any sort.
TEST(MeshEdges, areThoseThatCountingFinds) {
  std::mt19937 random(7);
  for (int round = 0; round < 40; ++round) {
    std::vector<glm::vec3> points(12);
    for (glm::vec3& p : points) p = {int(random() % 3), int(random() % 3), int(random() % 3)};
    Triangles triangles(20);
    for (auto& triangle : triangles)
      for (int& corner : triangle) corner = int(random() % points.size());
    const Primitive mesh = meshOf(points, triangles, random() % 2 == 0);
    // Places, and each set of three of them once.
    const auto less = [](const glm::vec3& a, const glm::vec3& b) {
      return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    std::map<glm::vec3, int, decltype(less)> placeOf(less);
    for (const glm::vec3& p : mesh.positions) placeOf.try_emplace(p, int(placeOf.size()));
    std::map<std::pair<int, int>, std::map<int, int>> thirds;  // by edge: third place, direction
    for (size_t t = 0; t < mesh.indices.size(); t += 3) {
      int at[3];
      for (size_t i = 0; i < 3; ++i) at[i] = placeOf.at(mesh.positions[mesh.indices[t + i]]);
      if (at[0] == at[1] || at[1] == at[2] || at[2] == at[0]) continue;
      for (int i = 0; i < 3; ++i) {
        const int a = at[i], b = at[(i + 1) % 3];
        thirds[std::minmax(a, b)].try_emplace(at[(i + 2) % 3], a < b ? 1 : -1);
      }
    }
    std::map<std::pair<int, int>, std::pair<size_t, size_t>> expected, found;  // pairs and ends
    for (const auto& [edge, sides] : thirds) {
      const size_t forward = size_t(std::count_if(sides.begin(), sides.end(),
                                                  [](const auto&side) { return side.second > 0; })),
                   backward = sides.size() - forward;
      expected[edge] = {std::min(forward, backward),
                        std::max(forward, backward) - std::min(forward, backward)};
    }
    for (const MeshEdge& edge : edgesOf(mesh)) {
      const auto at = [&](uint32_t vertex) { return placeOf.at(mesh.positions[vertex]); };
      auto& entry = found[std::minmax(at(edge.a), at(edge.b))];
      ++(edge.right == MeshEdge::kNone ? entry.second : entry.first);
    }
    EXPECT_EQ(found, expected) << "round " << round;
  }
}

TEST(MeshEdges, knowWhereColorsDiffer) {
  const std::vector<glm::vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  Primitive mesh = meshOf(points, {{0, 1, 2}, {1, 0, 3}}, true);
  mesh.colors.assign(6, glm::u8vec4(200, 100, 50, 255));
  const auto between = [&] {
    const std::vector<MeshEdge> edges = edgesOf(mesh);
    return std::find_if(edges.begin(), edges.end(),
                        [](const MeshEdge& e) { return e.right != MeshEdge::kNone; })
        ->kinds;
  };
  EXPECT_EQ(between(), 0u);
  for (size_t v = 3; v < 6; ++v) mesh.colors[v].g = 20;
  EXPECT_EQ(between(), uint32_t(kColorBorder));
  mesh.colors[3].g = 100;  // they agree at one end: a gradient
  EXPECT_EQ(between(), 0u);
}

TEST(MeshEdges, goOnFromOnePrimitiveToAnother) {
  const Triangles halves[] = {{kCubeSides.begin(), kCubeSides.begin() + 4},
                              {kCubeSides.begin() + 4, kCubeSides.end()}};
  const Primitive a = meshOf(kCube, halves[0], true), b = meshOf(kCube, halves[1], false);
  const std::vector<MeshEdge> edgesOfA = edgesOf(a), edgesOfB = edgesOf(b);
  const Primitive* const primitives[] = {&a, &b};
  const std::vector<MeshEdge>* const edges[] = {&edgesOfA, &edgesOfB};
  const std::vector<SharedEdge> shared = sharedEdges(primitives, edges);
  EXPECT_EQ(shared.size(), 8u);
  EXPECT_EQ(openOnes(edgesOfA) + openOnes(edgesOfB), 16u);
  for (const SharedEdge& edge : shared) {
    const MeshEdge &one = edgesOfA[edge.edge], &other = edgesOfB[edge.otherEdge];
    EXPECT_EQ(edge.primitive, 0u);
    EXPECT_EQ(edge.otherPrimitive, 1u);
    EXPECT_EQ(a.positions[one.a], b.positions[other.b]);
    EXPECT_EQ(a.positions[one.b], b.positions[other.a]);
  }
}

// Colours differ from one primitive to the other as they do within one; what has none is white.
TEST(MeshEdges, knowWhereColorsOfPrimitivesDiffer) {
  const std::vector<glm::vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  Primitive above = meshOf(points, {{0, 1, 2}}, true), below = meshOf(points, {{1, 0, 3}}, true);
  const auto between = [&] {
    const std::vector<MeshEdge> edgesOfAbove = edgesOf(above), edgesOfBelow = edgesOf(below);
    const Primitive* const primitives[] = {&above, &below};
    const std::vector<MeshEdge>* const edges[] = {&edgesOfAbove, &edgesOfBelow};
    const std::vector<SharedEdge> shared = sharedEdges(primitives, edges);
    EXPECT_EQ(shared.size(), 1u);
    return shared.at(0).kinds;
  };
  EXPECT_EQ(between(), 0u) << "neither has any";
  above.colors.assign(3, glm::u8vec4(255));
  EXPECT_EQ(between(), 0u);
  above.colors.assign(3, glm::u8vec4(200, 100, 50, 255));
  EXPECT_EQ(between(), uint32_t(kColorBorder));
  below.colors = above.colors;
  EXPECT_EQ(between(), 0u);
  // A gradient along the edge: each end agrees with its own place, whichever way the other one goes.
  above.colors = {glm::u8vec4(0), glm::u8vec4(255), glm::u8vec4(9)};
  below.colors = {glm::u8vec4(255), glm::u8vec4(0), glm::u8vec4(9)};
  EXPECT_EQ(between(), 0u);
  below.colors[0].r = 20;
  EXPECT_EQ(between(), 0u) << "they agree at one end";
  below.colors[1].r = 200;
  EXPECT_EQ(between(), uint32_t(kColorBorder));
  below.colors[0].r = 255;
  EXPECT_EQ(between(), 0u) << "they agree at the other end";
}

// A million triangles take less than a second; islands are no worse. Measured against a yardstick of sorting,
// since machines are noisy.
TEST(MeshEdges, aMillionTrianglesAreQuick) {
  constexpr int kSide = 708;
  Primitive mesh;
  for (int y = 0; y <= kSide; ++y)
    for (int x = 0; x <= kSide; ++x) mesh.positions.push_back({x, y, float(x * y % 7)});
  for (uint32_t y = 0; y < kSide; ++y)
    for (uint32_t x = 0; x < kSide; ++x) {
      const uint32_t at = y * (kSide + 1) + x, up = at + kSide + 1;
      for (const uint32_t v : {at, at + 1, up + 1, at, up + 1, up}) mesh.indices.push_back(v);
    }
  const auto now = [] { return std::chrono::steady_clock::now(); };
  const auto seconds = [](auto time) { return std::chrono::duration<double>(time).count(); };
  std::vector<uint32_t> numbers(mesh.indices.size());
  std::mt19937 random(3);
  for (uint32_t& number : numbers) number = uint32_t(random());
  const auto start = now();
  std::sort(numbers.begin(), numbers.end());
  const double yardstick = seconds(now() - start);
  const auto before = now();
  const size_t count = edgesOf(mesh).size();
  const double took = seconds(now() - before);
  EXPECT_EQ(count, size_t(3 * kSide * kSide + 2 * kSide));
  RecordProperty("seconds", std::to_string(took));
  EXPECT_LT(took, 6 * yardstick) << took << " s against " << yardstick
                                 << " s of sorting three million numbers";
}

}  // namespace
}  // namespace scumble::scene
