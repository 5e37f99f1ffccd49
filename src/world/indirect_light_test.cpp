// Light between surfaces against rays without a tree, in double precision; and what it follows from.
#include "world/indirect_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace scumble::world {
namespace {

// Squares with a grid of vertices on them; each is a primitive.
class IndirectLight : public ::testing::Test {
 protected:
  static constexpr int kCells = 8;

  struct Square {
    glm::vec3 corner, u, v;
    glm::vec3 color;
  };

  static scene::Primitive grid(const Square& square) {
    scene::Primitive p;
    for (int j = 0; j <= kCells; ++j)
      for (int i = 0; i <= kCells; ++i) {
        const glm::vec2 at = glm::vec2(i, j) / float(kCells);
        p.positions.push_back(square.corner + at.x * square.u + at.y * square.v);
        p.normals.push_back(glm::normalize(glm::cross(square.u, square.v)));
        p.uv0.push_back(at);
      }
    for (uint32_t j = 0; j < kCells; ++j)
      for (uint32_t i = 0; i < kCells; ++i) {
        const uint32_t a = j * (kCells + 1) + i, b = a + 1, c = a + kCells + 1, d = c + 1;
        for (const uint32_t v : {a, b, d, a, d, c}) p.indices.push_back(v);
      }
    return p;
  }

  // An item that stands at a place, with a material of its own.
  void add(const Square& square, const glm::mat4& model = glm::mat4(1.0f), int skin = -1) {
    squares_.push_back(square);
    primitives_.push_back(std::make_unique<scene::Primitive>(grid(square)));
    scene::Material material;
    material.baseColor = glm::vec4(square.color, 1);
    materials_.push_back(material);
    GeometryItem item;
    item.primitive = primitives_.back().get();
    item.model = model;
    item.skin = skin;
    item.material = uint32_t(materials_.size() - 1);
    items_.push_back(item);
  }

  std::vector<std::vector<glm::u8vec4>> bake(float reach) const {
    return indirectLight(
        items_, [this](size_t m) -> const scene::Material& { return materials_[m]; }, {}, reach);
  }

  // Many rays against squares: linear colour, and share.
  glm::dvec4 expectedAt(const glm::dvec3& point, const glm::dvec3& normal, double reach) const {
    const glm::dvec3 side = glm::normalize(glm::cross(
                         normal, std::abs(normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0))),
                     other = glm::cross(normal, side);
    constexpr int kRings = 60, kSectors = 120;
    glm::dvec3 color(0.0);
    double share = 0;
    for (int r = 0; r < kRings; ++r)
      for (int s = 0; s < kSectors; ++s) {
        const double out = std::sqrt((r + 0.5) / kRings), turn = 2 * std::numbers::pi * (s + 0.5) / kSectors;
        const glm::dvec3 way =
            out * std::cos(turn) * side + out * std::sin(turn) * other + std::sqrt(1 - out * out) * normal;
        double nearest = reach;
        const Square* seen = nullptr;
        for (const Square& square : squares_) {
          const glm::dvec3 u(square.u), v(square.v), across = glm::cross(u, v);
          const double t = glm::dot(glm::dvec3(square.corner) - point, across) / glm::dot(way, across);
          const glm::dvec3 at = point + t * way - glm::dvec3(square.corner);
          const double x = glm::dot(at, u) / glm::dot(u, u), y = glm::dot(at, v) / glm::dot(v, v);
          if (t > 1e-3 * reach && t < nearest && x >= 0 && x <= 1 && y >= 0 && y <= 1)
            nearest = t, seen = &square;
        }
        if (!seen) continue;
        color += (1 - nearest / reach) * glm::dvec3(seen->color);
        share += 1 - nearest / reach;
      }
    return {share > 0 ? color / share : glm::dvec3(0.0), share / (kRings * kSectors)};
  }

  std::vector<Square> squares_;
  std::vector<std::unique_ptr<scene::Primitive>> primitives_;
  std::vector<scene::Material> materials_;
  std::vector<GeometryItem> items_;
};

const glm::vec3 kFloor(0.8f, 0.7f, 0.6f), kRed(0.9f, 0.1f, 0.05f), kGreen(0.1f, 0.6f, 0.1f);

TEST_F(IndirectLight, isWhatRaysMeet) {
  add({{-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, kFloor});
  add({{-1, 0, -1}, {2, 0, 0}, {0, 1.5f, 0}, kRed});
  add({{0.7f, 0.1f, -0.6f}, {0, 1, 0}, {0, 0, 1.4f}, kGreen});
  for (const float reach : {0.4f, 1.0f, 5.0f}) {
    const auto found = bake(reach);
    for (size_t i = 0; i < items_.size(); ++i) {
      ASSERT_EQ(found[i].size(), primitives_[i]->positions.size());
      for (size_t v = 0; v < found[i].size(); ++v) {
        const glm::dvec4 expected = expectedAt(glm::dvec3(primitives_[i]->positions[v]),
                                               glm::dvec3(primitives_[i]->normals[v]), reach);
        EXPECT_NEAR(found[i][v].a / 255.0, expected.a, 0.06) << i << ", " << v << ", reach " << reach;
        if (expected.a < 0.1) continue;
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(found[i][v][c] / 255.0, std::sqrt(expected[c]), 0.09) << i << ", " << v;
      }
    }
  }
}

// As large or as small, and mirrored: the same.
TEST_F(IndirectLight, followsFromTheFormAlone) {
  add({{-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, kFloor});
  add({{-1, 0, -1}, {2, 0, 0}, {0, 1.5f, 0}, kRed});
  const auto here = bake(1);
  for (const float size : {0.001f, 1000.0f}) {
    for (GeometryItem& item : items_) item.model = glm::scale(glm::mat4(1.0f), glm::vec3(size));
    const auto there = bake(size);
    for (size_t i = 0; i < here.size(); ++i)
      for (size_t v = 0; v < here[i].size(); ++v)
        EXPECT_NEAR(there[i][v].a, here[i][v].a, 5) << size << ": " << i << ", " << v;
  }
  for (GeometryItem& item : items_) item.model = glm::scale(glm::mat4(1.0f), {1, 1, -1});
  const auto mirrored = bake(1);
  for (size_t i = 0; i < here.size(); ++i)
    for (size_t v = 0; v < here[i].size(); ++v)
      EXPECT_NEAR(mirrored[i][v].a, here[i][v].a, 12) << i << ", " << v;
}

// What a skin bends has nothing around it but itself; what is hidden and the ground take no part; a reach of
// 0 is none.
TEST_F(IndirectLight, isOfWhatStands) {
  add({{-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, kFloor});
  add({{-1, 0, -1}, {2, 0, 0}, {0, 1.5f, 0}, kRed}, glm::mat4(1.0f), 0);
  for (const auto& item : bake(1))
    for (const glm::u8vec4& vertex : item) EXPECT_EQ(vertex.a, 0);
  items_[1].skin = -1;
  items_[1].shown = false;
  EXPECT_TRUE(bake(1)[1].empty());
  EXPECT_EQ(bake(1)[0][1].a, 0);
  items_[1].shown = true;
  EXPECT_GT(bake(1)[0][1].a, 15);
  items_[1].node = GeometryItem::kNoNode;
  EXPECT_EQ(bake(1)[0][1].a, 0);
  for (const auto& item : bake(0)) EXPECT_TRUE(item.empty());
}

}  // namespace
}  // namespace scumble::world
