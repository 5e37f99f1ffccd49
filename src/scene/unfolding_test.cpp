// Surfaces that are known, laid flat: how much they are stretched, and where they are cut.
#include "scene/unfolding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <tuple>

#include "scene/mapping_faults.h"
#include "scene/prepare_mesh.h"

namespace scumble::scene {
namespace {

constexpr float kTurn = 6.2831853f;

// A sheet of `count` x `count` cells, bent to what `placeOf` says of (0, 0) to (1, 1). Every corner of a
// triangle is a vertex of its own, as flat shading has it: what belongs together is to be found by places.
Primitive sheet(int count, const std::function<glm::vec3(float, float)>& placeOf) {
  Primitive p;
  for (int cell = 0; cell < count * count; ++cell) {
    const auto corner = [&](int k) {
      return placeOf(float(cell % count + k % 2) / float(count), float(cell / count + k / 2) / float(count));
    };
    for (const int k : {0, 1, 3, 0, 3, 2}) {
      p.indices.push_back(uint32_t(p.positions.size()));
      p.positions.push_back(corner(k));
    }
  }
  return p;
}
Primitive ball(int count) {
  return sheet(count, [](float s, float t) {
    const float height = 0.5f * kTurn * t;
    return glm::vec3(std::sin(height) * std::cos(-kTurn * s), std::cos(height),
                     std::sin(height) * std::sin(-kTurn * s));
  });
}
Primitive tube(int count) {
  return sheet(count, [](float s, float t) {
    return glm::vec3(0.5f * std::cos(-kTurn * s), 4 * t, 0.5f * std::sin(-kTurn * s));
  });
}
Primitive die() {
  Primitive p;
  for (int side = 0; side < 6; ++side) {
    glm::vec3 out(0), along(0);
    out[side / 2] = side % 2 ? 1.0f : -1.0f, along[(side / 2 + 1) % 3] = 1;
    const glm::vec3 across = glm::cross(out, along);
    for (const auto& [a, b] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, -1}, {1, 1}, {-1, 1}}) {
      p.indices.push_back(uint32_t(p.positions.size()));
      p.positions.push_back(out + float(a) * along + float(b) * across);
    }
  }
  return p;
}

Primitive laid(const Primitive& p, const Unfolding& u) {
  Primitive flat;
  for (const uint32_t v : u.source) flat.positions.push_back(p.positions[v]);
  flat.indices = u.indices, flat.uv0 = u.uvs;
  return flat;
}

// How many times longer and shorter what lies is than what was, over all triangles; and what is mirrored.
struct Stretch {
  double least = 1e9, most = 0;
  size_t mirrored = 0;
};
Stretch stretchOf(const Primitive& p, const Unfolding& u, double scale) {
  Stretch s;
  for (size_t i = 0; i < p.indices.size(); i += 3) {
    const auto at = [&](size_t k) { return glm::dvec3(p.positions[p.indices[i + k]]) * scale; };
    const auto uv = [&](size_t k) { return glm::dvec2(u.uvs[u.indices[i + k]]); };
    const glm::dvec3 x = at(1) - at(0), side = at(2) - at(0);
    const double length = glm::length(x), along = glm::dot(side, x) / length;
    const double height = glm::length(side - along * x / length);
    if (height < 1e-6) continue;
    const glm::dvec2 ofX = (uv(1) - uv(0)) / length, ofY = (uv(2) - uv(0) - along * ofX) / height;
    const double det = ofX.x * ofY.y - ofX.y * ofY.x, sum = glm::dot(ofX, ofX) + glm::dot(ofY, ofY);
    const double difference = std::sqrt(std::max(sum * sum - 4 * det * det, 0.0));
    s.most = std::max(s.most, std::sqrt((sum + difference) / 2));
    s.least = std::min(s.least, std::sqrt(std::max(sum - difference, 0.0) / 2));
    s.mirrored += det <= 0;
  }
  return s;
}

// Whatever is laid keeps its triangles, and vertices that were there stay where they were.
void expectTheSameTriangles(const Primitive& p, const Unfolding& u) {
  ASSERT_EQ(u.indices.size(), p.indices.size());
  ASSERT_EQ(u.source.size(), u.uvs.size());
  ASSERT_GE(u.source.size(), p.vertexCount());
  for (size_t v = 0; v < p.vertexCount(); ++v) EXPECT_EQ(u.source[v], v);
  for (size_t i = 0; i < p.indices.size(); ++i) EXPECT_EQ(u.source[u.indices[i]], p.indices[i]);
  for (const glm::vec2& uv : u.uvs) EXPECT_TRUE(std::isfinite(uv.x) && std::isfinite(uv.y));
}

// What is flat already, or bent one way only, is laid as it is; of any size.
TEST(Unfolding, whatCanLieFlatLiesAsItIs) {
  for (const float size : {1.0f, 1e-6f, 1e6f}) {
    Primitive plane = sheet(12, [](float s, float t) { return glm::vec3(s, t, 0); }), roll = tube(24);
    for (Primitive* const p : {&plane, &roll}) {
      for (glm::vec3& at : p->positions) at *= size;
      const Unfolding u = unfold(*p, 1 / size);
      expectTheSameTriangles(*p, u);
      const Stretch s = stretchOf(*p, u, 1 / double(size));
      EXPECT_NEAR(s.least, 1, 2e-3);
      EXPECT_NEAR(s.most, 1, 2e-3);
      EXPECT_EQ(s.mirrored, 0u);
    }
    EXPECT_EQ(mappingFaults(laid(plane, unfold(plane, 1 / size)), 1 / size).seams, 0);
    // One seam along, if not quite straight.
    const float seam = 4 / std::sqrt(0.5f * kTurn * 4);
    EXPECT_NEAR(mappingFaults(laid(roll, unfold(roll, 1 / size)), 1 / size).seams, seam, 0.15f * seam);
  }
}

// Upright patterns: u runs along the ground wherever a piece begins.
TEST(Unfolding, uprightIsUpright) {
  const Primitive p = sheet(6, [](float s, float t) { return glm::vec3(0.6f * s, t, -0.8f * s); });
  const Unfolding u = unfold(p, 1);
  for (size_t i = 0; i < p.indices.size(); ++i) {
    const glm::vec2 off = u.uvs[u.indices[i]] - u.uvs[u.indices[0]];
    const glm::vec3 way = p.positions[p.indices[i]] - p.positions[p.indices[0]];
    EXPECT_NEAR(off.y, way.y, 1e-3);
    EXPECT_NEAR(off.x, glm::dot(way, glm::vec3(0.6f, 0, -0.8f)), 1e-3);
  }
}

// A ball cannot lie flat without being stretched or cut; it is both. Around is 1.77, and six faces of a box
// around it have 4.1 of borders.
TEST(Unfolding, aBallIsCutAndStretched) {
  const Primitive p = ball(32);
  const Unfolding u = unfold(p, 1);
  expectTheSameTriangles(p, u);
  const Stretch s = stretchOf(p, u, 1);
  EXPECT_EQ(s.mirrored, 0u);
  EXPECT_LT(s.most, 4);
  EXPECT_GT(s.least, 0.25);
  EXPECT_LT(mappingFaults(laid(p, u), 1).seams, 5);
  EXPECT_EQ(mappingFaults(laid(p, u), 1).uneven, 0);
}

// All faces of a cube are in one piece: 7 of its 12 edges are cut, as of any.
TEST(Unfolding, aCubeIsOnePiece) {
  const Primitive p = die();
  const Unfolding u = unfold(p, 1);
  const Stretch s = stretchOf(p, u, 1);
  EXPECT_NEAR(s.least, 1, 1e-3);
  EXPECT_NEAR(s.most, 1, 1e-3);
  std::map<std::tuple<int, int, int>, std::vector<glm::vec2>> byMiddle;
  size_t cut = 0;
  for (size_t i = 0; i < p.indices.size(); i += 3)
    for (size_t k = 0; k < 3; ++k) {
      const glm::vec3 middle = p.positions[p.indices[i + k]] + p.positions[p.indices[i + (k + 1) % 3]];
      const glm::vec2 uv = 0.5f * (u.uvs[u.indices[i + k]] + u.uvs[u.indices[i + (k + 1) % 3]]);
      auto& known =
          byMiddle[{int(std::lround(middle.x)), int(std::lround(middle.y)), int(std::lround(middle.z))}];
      cut += !known.empty() && glm::distance(known[0], uv) > 1e-3f;
      known.push_back(uv);
    }
  EXPECT_EQ(cut, 7u);
}

// Cutting adds no more vertices than there are at seams.
TEST(Unfolding, verticesAreAddedAtSeamsAlone) {
  Primitive p;
  constexpr int kAround = 40, kAlong = 40;
  for (int j = 0; j <= kAlong; ++j)
    for (int i = 0; i < kAround; ++i) {
      const float angle = -kTurn * float(i) / kAround;
      p.positions.push_back({std::cos(angle), 0.1f * float(j), std::sin(angle)});
    }
  for (uint32_t j = 0; j < kAlong; ++j)
    for (uint32_t i = 0; i < kAround; ++i) {
      const uint32_t a = j * kAround + i, b = j * kAround + (i + 1) % kAround;
      p.indices.insert(p.indices.end(), {a, b, b + kAround, a, b + kAround, a + kAround});
    }
  const Unfolding u = unfold(p, 1);
  expectTheSameTriangles(p, u);
  EXPECT_EQ(u.source.size(), p.vertexCount() + kAlong + 1);
}

// What bends everywhere, and much: nothing is mirrored, also after everything has been relaxed, and nothing
// is stretched too much.
TEST(Unfolding, boundsHoldWhateverTheForm) {
  for (const int count : {12, 40}) {
    const Primitive p = sheet(count, [](float s, float t) {
      const float height = 0.5f * kTurn * t, r = 1 + 0.45f * std::sin(5 * kTurn * s) * std::sin(7 * height);
      return r * glm::vec3(std::sin(height) * std::cos(-kTurn * s), 2.5f * std::cos(height),
                           std::sin(height) * std::sin(-kTurn * s));
    });
    const Unfolding u = unfold(p, 0.4f);
    expectTheSameTriangles(p, u);
    const Stretch s = stretchOf(p, u, 0.4);
    EXPECT_EQ(s.mirrored, 0u) << count;
    EXPECT_LT(s.most, 4.01) << count;
    EXPECT_GT(s.least, 0.249) << count;
  }
}

// A grid whose cells share their vertices, in the plane z = 0; `heights` of its rows.
Primitive strip(int across, const std::vector<float>& heights) {
  Primitive p;
  for (const float height : heights)
    for (int i = 0; i <= across; ++i) p.positions.push_back({float(i), height, 0});
  const auto row = uint32_t(across) + 1;
  for (uint32_t j = 0; j + 1 < heights.size(); ++j)
    for (uint32_t i = j * row; i + 1 < (j + 1) * row; ++i)
      p.indices.insert(p.indices.end(), {i, i + 1, i + 1 + row, i, i + 1 + row, i + row});
  return p;
}

// The back of a sheet, at the same places, goes on beyond its border, and neither is cut.
TEST(Unfolding, sheetsOfTwoSidesAreNotCut) {
  Primitive p = strip(10, {0, 1, 2, 3, 4});
  const size_t once = p.indices.size();
  for (size_t i = 0; i < once; i += 3)
    p.indices.insert(p.indices.end(), {p.indices[i], p.indices[i + 2], p.indices[i + 1]});
  const Unfolding u = unfold(p, 0.1f);
  expectTheSameTriangles(p, u);
  EXPECT_LE(u.source.size(), 2 * p.vertexCount());
  EXPECT_NEAR(stretchOf(p, u, 0.1).least, 1, 1e-3);
}

// What is thinner than places are apart does not cut what lies on its sides.
TEST(Unfolding, sliversDoNotCut) {
  const Primitive p = strip(20, {0, 1, 1 + 1e-6f, 2});
  const Unfolding u = unfold(p, 0.1f);
  expectTheSameTriangles(p, u);
  EXPECT_EQ(u.source.size(), p.vertexCount());
}

// Small things beside a large scale keep the digits of their coordinates.
TEST(Unfolding, smallThingsKeepTheirForm) {
  const Primitive p = ball(16);
  const Stretch s = stretchOf(p, unfold(p, 1e-6f), 1e-6);
  EXPECT_EQ(s.mirrored, 0u);
  EXPECT_LT(s.most, 4.01);
  EXPECT_GT(s.least, 0.249);
}

TEST(Unfolding, isTheSameEveryTime) {
  const Primitive p = ball(20);
  const Unfolding a = unfold(p, 1), b = unfold(p, 1);
  EXPECT_EQ(a.uvs, b.uvs);
  EXPECT_EQ(a.indices, b.indices);
}

TEST(Unfolding, hostileMeshes) {
  Primitive fan = sheet(4, [](float s, float t) { return glm::vec3(s, t, 0); });
  // Ten triangles at one edge, some the other way around; all of them twice; a line; a point.
  for (int i = 0; i < 10; ++i) {
    const auto first = uint32_t(fan.positions.size());
    fan.positions.insert(fan.positions.end(),
                         {{0, 0, 0}, {1, 0, 0}, {0.5f, std::sin(float(i)), std::cos(float(i))}});
    fan.indices.insert(fan.indices.end(), {first, first + 1 + uint32_t(i % 2), first + 2 - uint32_t(i % 2)});
  }
  const std::vector<uint32_t> once = fan.indices;
  fan.indices.insert(fan.indices.end(), once.begin(), once.end());
  fan.positions.insert(fan.positions.end(), {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}});
  const auto last = uint32_t(fan.positions.size());
  fan.indices.insert(fan.indices.end(), {last - 3, last - 2, last - 1, last - 1, last - 1, last - 1});
  for (const glm::vec3& size :
       {glm::vec3(1), glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(1e15f), glm::vec3(1e-30f)}) {
    Primitive p = fan;
    for (glm::vec3& at : p.positions) at *= size;
    for (const float scale : {1.0f, 1e-15f, 1e20f}) expectTheSameTriangles(p, unfold(p, scale));
  }
  EXPECT_TRUE(unfold(Primitive(), 1).indices.empty());
}

// A hundred thousand triangles at one place, with a vertex that they share or one each, whether they meet at
// edges or not: in moments, not in minutes.
TEST(Unfolding, manyTrianglesAtOnePlace) {
  constexpr uint32_t kCount = 100000;
  for (const bool sharesVertices : {false, true})
    for (const bool meets : {false, true}) {
      Primitive p;
      p.positions.push_back({0, 1, 0});
      for (uint32_t i = 0; i < kCount; ++i) {
        const auto rim = [&](float part) {
          const float angle = -kTurn * (float(i) + part) / kCount * (meets ? 1.0f : 0.9f);
          return glm::vec3(100 * std::cos(angle), i % 2 ? 0.1f : 0.0f, 100 * std::sin(angle));
        };
        if (!sharesVertices) p.positions.push_back(p.positions[0]);
        const uint32_t hub = sharesVertices ? 0 : uint32_t(p.positions.size() - 1);
        const auto first = uint32_t(p.positions.size());
        p.positions.push_back(rim(0)), p.positions.push_back(rim(meets ? 1.0f : 0.5f));
        p.indices.insert(p.indices.end(), {hub, first, first + 1});
      }
      expectTheSameTriangles(p, unfold(p, 0.01f));
    }
}

}  // namespace
}  // namespace scumble::scene
