#include "world/tessellate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include "scene/posed_bounds.h"

namespace scumble::world {
namespace {

using scene::Primitive;

void addTriangle(Primitive& p, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
  for (const glm::vec3& v : {a, b, c}) {
    p.indices.push_back(uint32_t(p.positions.size()));
    p.positions.push_back(v);
    p.normals.push_back(normal);
    p.smoothNormals.push_back(normal);
    // Linear in the position, so that what is interpolated can be foretold.
    p.uv0.push_back({v.x + 2 * v.y, v.z - v.x});
    p.uv1.push_back({v.y, v.z});
    p.patternUv.push_back({v.z, v.y});
    p.dPdu.push_back({v.x, 1, 0});
    p.dPdv.push_back({0, 1, v.z});
    p.colors.push_back(glm::u8vec4(glm::clamp(v * 10.0f + 100.0f, 0.0f, 255.0f), 255));
  }
  p.extent = scene::extentOf(p);
}

// A closed box whose faces share no vertices, as flat shading makes them.
Primitive box(const glm::vec3& size) {
  const auto corner = [&](int i) {
    return glm::vec3(i & 1 ? size.x : 0, i & 2 ? size.y : 0, i & 4 ? size.z : 0);
  };
  constexpr int kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  Primitive p;
  for (const auto& f : kFaces) {
    addTriangle(p, corner(f[0]), corner(f[1]), corner(f[2]));
    addTriangle(p, corner(f[0]), corner(f[2]), corner(f[3]));
  }
  return p;
}

// Vertices shared by neighbours: a bumpy sheet with cells of very different sizes.
Primitive sheet(uint32_t seed) {
  std::mt19937 random(seed);
  const auto number = [&] { return float(random() % 1000) / 1000; };
  constexpr uint32_t kSide = 5;
  Primitive p;
  std::array<float, kSide> x{}, z{};
  for (uint32_t i = 1; i < kSide; ++i)
    x[i] = x[i - 1] + 0.05f + 3 * number(), z[i] = z[i - 1] + 0.05f + 3 * number();
  for (uint32_t i = 0; i < kSide * kSide; ++i) {
    p.positions.push_back({x[i % kSide], number(), z[i / kSide]});
    p.normals.push_back({0, 1, 0});
  }
  for (uint32_t r = 0; r + 1 < kSide; ++r)
    for (uint32_t c = 0; c + 1 < kSide; ++c) {
      const uint32_t a = r * kSide + c, b = a + 1, d = a + kSide, e = d + 1;
      p.indices.insert(p.indices.end(), {a, d, b, b, d, e});
    }
  p.extent = scene::extentOf(p);
  return p;
}

float longestEdge(const Primitive& p) {
  float longest = 0;
  for (size_t i = 0; i < p.indices.size(); i += 3)
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, glm::length(p.positions[p.indices[i + size_t(k)]] -
                                              p.positions[p.indices[i + size_t(k + 1) % 3]]));
  return longest;
}

double areaOf(const Primitive& p) {
  double area = 0;
  for (size_t i = 0; i < p.indices.size(); i += 3) {
    const glm::dvec3 a(p.positions[p.indices[i]]), b(p.positions[p.indices[i + 1]]),
        c(p.positions[p.indices[i + 2]]);
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return area;
}

scene::Bounds boundsOf(const Primitive& p) {
  scene::Bounds bounds;
  for (const uint32_t i : p.indices) bounds.add(p.positions[i]);
  return bounds;
}

// How often each directed edge is there, by position: in a surface without tears and flips, each one lies
// against its opposite, but at the border.
using Point = std::array<float, 3>;
std::map<std::pair<Point, Point>, int> edgesOf(const Primitive& p) {
  std::map<std::pair<Point, Point>, int> edges;
  const auto point = [&](uint32_t i) { return Point{p.positions[i].x, p.positions[i].y, p.positions[i].z}; };
  for (size_t i = 0; i < p.indices.size(); i += 3)
    for (size_t k = 0; k < 3; ++k) ++edges[{point(p.indices[i + k]), point(p.indices[i + (k + 1) % 3])}];
  return edges;
}

double borderOf(const Primitive& p) {
  double length = 0;
  const auto edges = edgesOf(p);
  for (const auto& [edge, count] : edges) {
    const auto opposite = edges.find({edge.second, edge.first});
    const int unmatched = count - (opposite == edges.end() ? 0 : opposite->second);
    if (unmatched <= 0) continue;
    length +=
        unmatched * std::hypot(double(edge.first[0]) - edge.second[0], double(edge.first[1]) - edge.second[1],
                               double(edge.first[2]) - edge.second[2]);
  }
  return length;
}

constexpr size_t kPlenty = 1 << 20;

TEST(Tessellate, noEdgeAboveTheCapAndTheSurfaceStays) {
  std::vector<Primitive> inputs;
  for (uint32_t seed = 0; seed < 10; ++seed) inputs.push_back(sheet(seed));
  for (const glm::vec3& size : {glm::vec3(1, 1, 1), glm::vec3(40, 0.1f, 2), glm::vec3(0.01f, 9, 0.01f)})
    inputs.push_back(box(size));
  for (const Primitive& input : inputs)
    for (const float cap : {0.9f, 0.37f}) {
      if (longestEdge(input) <= cap) continue;
      const std::optional<Primitive> result = tessellate(input, cap, kPlenty);
      ASSERT_TRUE(result.has_value());
      EXPECT_LE(longestEdge(*result), cap * 1.0001f);
      EXPECT_GT(longestEdge(*result), cap * 0.25f) << "split far finer than asked for";
      EXPECT_NEAR(areaOf(*result), areaOf(input), 1e-4 * areaOf(input));
      EXPECT_EQ(boundsOf(*result).min, boundsOf(input).min);
      EXPECT_EQ(boundsOf(*result).max, boundsOf(input).max);
      // The border is as long as before: 0 for boxes, whose faces share edges but no vertices.
      EXPECT_NEAR(borderOf(*result), borderOf(input), 1e-4 * (1 + borderOf(input)));
      for (const uint32_t index : result->indices) ASSERT_LT(index, result->vertexCount());
    }
}

// The same edge, once in a large triangle and once in a small one, of two primitives.
TEST(Tessellate, primitivesThatShareAnEdgeSplitItAlike) {
  Primitive large, small;
  const glm::vec3 a(0, 0, 0), b(7.3f, 1.1f, -2.7f);
  addTriangle(large, a, b, {3, 9, 4});
  addTriangle(small, b, a, {3, -0.2f, -1});
  const auto onTheEdge = [&](const Primitive& p) {
    std::vector<Point> points;
    for (const glm::vec3& v : p.positions)
      if (glm::length(glm::cross(v - a, b - a)) < 1e-5f * glm::dot(b - a, b - a))
        points.push_back({v.x, v.y, v.z});
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
  };
  const auto first = tessellate(large, 0.5f, kPlenty), second = tessellate(small, 0.5f, kPlenty);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(onTheEdge(*first), onTheEdge(*second));
  EXPECT_GE(onTheEdge(*first).size(), 17u);
}

TEST(Tessellate, trianglesKeepTheirSide) {
  const Primitive input = box({3, 2, 1});
  const auto result = tessellate(input, 0.4f, kPlenty);
  ASSERT_TRUE(result);
  for (size_t i = 0; i < result->indices.size(); i += 3) {
    const auto at = [&](size_t k) { return result->positions[result->indices[i + k]]; };
    const glm::vec3 face = glm::cross(at(1) - at(0), at(2) - at(0));
    ASSERT_GT(glm::dot(face, result->normals[result->indices[i]]), 0.0f);
  }
}

TEST(Tessellate, attributesAreInterpolated) {
  const Primitive input = box({3, 2, 1});
  const auto result = tessellate(input, 0.3f, kPlenty);
  ASSERT_TRUE(result);
  const size_t count = result->vertexCount();
  ASSERT_GT(count, input.vertexCount());
  ASSERT_EQ(result->normals.size(), count);
  ASSERT_EQ(result->smoothNormals.size(), count);
  ASSERT_EQ(result->uv0.size(), count);
  ASSERT_EQ(result->uv1.size(), count);
  ASSERT_EQ(result->patternUv.size(), count);
  ASSERT_EQ(result->dPdu.size(), count);
  ASSERT_EQ(result->dPdv.size(), count);
  ASSERT_EQ(result->colors.size(), count);
  for (size_t i = 0; i < count; ++i) {
    const glm::vec3 p = result->positions[i];
    EXPECT_NEAR(result->uv0[i].x, p.x + 2 * p.y, 1e-5f);
    EXPECT_NEAR(result->uv0[i].y, p.z - p.x, 1e-5f);
    EXPECT_NEAR(result->uv1[i].y, p.z, 1e-5f);
    EXPECT_NEAR(result->patternUv[i].x, p.z, 1e-5f);
    EXPECT_NEAR(result->dPdu[i].x, p.x, 1e-5f);
    EXPECT_NEAR(result->dPdv[i].z, p.z, 1e-5f);
    EXPECT_NEAR(glm::length(result->normals[i]), 1, 1e-5f);
    EXPECT_NEAR(glm::length(result->smoothNormals[i]), 1, 1e-5f);
    // Each round may round once.
    EXPECT_NEAR(result->colors[i].r, 100 + 10 * p.x, 4);
    EXPECT_EQ(result->colors[i].a, 255);
  }
}

TEST(Tessellate, normalsStayUnitLengthWhereTheyDiffer) {
  Primitive p;
  addTriangle(p, {0, 0, 0}, {4, 0, 0}, {0, 0, -4});
  p.normals = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}};  // two of them cancel out half-way
  const auto result = tessellate(p, 0.5f, kPlenty);
  ASSERT_TRUE(result);
  for (const glm::vec3& normal : result->normals) EXPECT_NEAR(glm::length(normal), 1, 1e-4f);
}

TEST(Tessellate, arraysThatAreEmptyStayEmpty) {
  const auto result = tessellate(sheet(1), 0.5f, kPlenty);
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->uv0.empty() && result->uv1.empty() && result->colors.empty() && result->dPdu.empty() &&
              result->smoothNormals.empty());
  EXPECT_EQ(result->normals.size(), result->vertexCount());
}

TEST(Tessellate, nothingToDoIsNothing) {
  EXPECT_FALSE(tessellate(box({1, 1, 1}), 1.5f, kPlenty).has_value());
  EXPECT_FALSE(tessellate(Primitive{}, 0.1f, kPlenty).has_value());
}

// What deforms is left alone: its edges change from frame to frame.
TEST(Tessellate, whatDeformsIsLeftAlone) {
  Primitive skinned = box({1, 1, 1});
  skinned.influences = 4;
  skinned.joints.assign(skinned.vertexCount() * 4, 0);
  skinned.weights.assign(skinned.vertexCount() * 4, 0.25f);
  EXPECT_FALSE(tessellate(skinned, 0.1f, kPlenty).has_value());
  Primitive morphing = box({1, 1, 1});
  morphing.morphTargets.resize(1);
  EXPECT_FALSE(tessellate(morphing, 0.1f, kPlenty).has_value());
}

TEST(Tessellate, theBudgetIsKept) {
  const Primitive input = box({10, 10, 10});
  const size_t before = input.indices.size() / 3;
  for (const size_t budget : {size_t(0), size_t(1), size_t(36), size_t(1000), size_t(20000)}) {
    const auto result = tessellate(input, 0.01f, budget);
    ASSERT_TRUE(result);
    EXPECT_LE(result->indices.size() / 3, before + budget);
    EXPECT_NEAR(areaOf(*result), areaOf(input), 1e-3);
    EXPECT_NEAR(borderOf(*result), 0, 1e-4) << "a box torn by running out of budget";
  }
}

}  // namespace
}  // namespace scumble::world
