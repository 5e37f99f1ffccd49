// The nearest place on triangles against a reference in double precision: planes and segments, without the
// regions by which the program decides.
#include "scene/nearest_place.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace scumble::scene {
namespace {

using dvec3 = glm::dvec3;

dvec3 onSegment(const dvec3& p, const dvec3& a, const dvec3& b) {
  const dvec3 way = b - a;
  return a + std::clamp(glm::dot(p - a, way) / glm::dot(way, way), 0.0, 1.0) * way;
}

// The foot on the plane where it lies within, else the nearest place of the three sides.
dvec3 onTriangle(const dvec3& p, const dvec3 (&corners)[3]) {
  const dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const dvec3 foot = p - glm::dot(p - corners[0], normal) / glm::dot(normal, normal) * normal;
  bool isWithin = true;
  for (int i = 0; i < 3; ++i)
    isWithin &= glm::dot(glm::cross(corners[(i + 1) % 3] - corners[i], foot - corners[i]), normal) >= 0;
  if (isWithin) return foot;
  dvec3 nearest = corners[0];
  for (int i = 0; i < 3; ++i) {
    const dvec3 place = onSegment(p, corners[i], corners[(i + 1) % 3]);
    if (glm::distance(p, place) < glm::distance(p, nearest)) nearest = place;
  }
  return nearest;
}

Primitive triangles(std::vector<glm::vec3> positions, std::vector<uint32_t> indices) {
  Primitive primitive;
  primitive.positions = std::move(positions);
  primitive.indices = std::move(indices);
  return primitive;
}

void expectNearest(const std::vector<const Primitive*>& primitives, const glm::vec3& p, double tolerance) {
  const NearestPlaces places(primitives);
  const NearestPlaces::Place got = places.to(p);
  double least = 1e300;
  for (const Primitive* primitive : primitives)
    for (size_t i = 0; i + 2 < primitive->indices.size(); i += 3) {
      dvec3 corners[3];
      for (size_t c = 0; c < 3; ++c) corners[c] = dvec3(primitive->positions[primitive->indices[i + c]]);
      least = std::min(least, glm::distance(dvec3(p), onTriangle(dvec3(p), corners)));
    }
  const glm::vec3 place = got.mixed(primitives[got.primitive]->positions);
  EXPECT_NEAR(glm::distance(dvec3(place), dvec3(p)), least, tolerance)
      << p.x << " " << p.y << " " << p.z << ": " << place.x << " " << place.y << " " << place.z;
  EXPECT_GE(got.at.x, 0.0f);
  EXPECT_GE(got.at.y, 0.0f);
  EXPECT_LE(got.at.x + got.at.y, 1.0f + 1e-6f);
  for (int c = 0; c < 3; ++c)
    EXPECT_EQ(got.vertices[c], primitives[got.primitive]->indices[3 * got.triangle + uint32_t(c)]);
}

// Above the inside, beside each side and beyond each corner, for triangles of all shapes and turns.
TEST(NearestPlace, allSevenRegionsOfATriangle) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> any(-1, 1);
  const auto vector = [&] { return glm::vec3(any(random), any(random), any(random)); };
  size_t tried[7] = {};
  for (int round = 0; round < 300; ++round) {
    const glm::vec3 a = vector(), b = vector(), c = vector();
    const glm::vec3 normal = glm::cross(b - a, c - a);
    if (glm::length(normal) < 0.1f) continue;
    const Primitive one = triangles({a, b, c}, {0, 1, 2});
    const glm::vec3 corners[] = {a, b, c}, middle = (a + b + c) / 3.0f;
    for (int region = 0; region < 7; ++region) {
      glm::vec3 p = middle;
      if (region >= 1 && region < 4) {
        const glm::vec3 &from = corners[region - 1], &to = corners[region % 3];
        p = 0.5f * (from + to) + 0.7f * glm::normalize(glm::cross(to - from, normal));
      } else if (region >= 4) {
        // Away from both other corners.
        const glm::vec3 corner = corners[region - 4], other = corners[(region - 3) % 3],
                        third = corners[(region - 2) % 3];
        p = corner + 0.8f * glm::normalize(glm::normalize(corner - other) + glm::normalize(corner - third));
      }
      for (const float above : {0.0f, 0.6f, -1.7f}) {
        expectNearest({&one}, p + above * glm::normalize(normal), 5e-6);
        ++tried[region];
      }
      const NearestPlaces::Place got = NearestPlaces(std::vector<const Primitive*>{&one}).to(p);
      const float parts[] = {1 - got.at.x - got.at.y, got.at.x, got.at.y};
      if (region == 0)
        for (const float part : parts) EXPECT_NEAR(part, 1.0f / 3, 1e-4f);
      // Of a side two corners, of a corner one.
      else if (region < 4)
        EXPECT_NEAR(parts[(region + 1) % 3], 0, 1e-6f) << region;
      else
        EXPECT_NEAR(parts[region - 4], 1, 1e-6f) << region;
    }
  }
  for (const size_t count : tried) EXPECT_GT(count, 300u);
}

TEST(NearestPlace, ofManyTrianglesOfSeveralPrimitives) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> any(-1, 1);
  const auto vector = [&](float size) { return size * glm::vec3(any(random), any(random), any(random)); };
  std::vector<Primitive> primitives(3);
  for (Primitive& primitive : primitives)
    for (int t = 0; t < 120; ++t) {
      const glm::vec3 at = vector(3);
      for (int c = 0; c < 3; ++c) {
        primitive.indices.push_back(uint32_t(primitive.positions.size()));
        primitive.positions.push_back(at + vector(0.5f));
      }
    }
  const std::vector<const Primitive*> all{&primitives[0], &primitives[1], &primitives[2]};
  for (int i = 0; i < 100; ++i) expectNearest(all, vector(4), 4e-6);
}

// Whatever order the tree has: of equally near ones the first.
TEST(NearestPlace, ofEquallyNearOnesTheFirst) {
  std::vector<glm::vec3> positions;
  std::vector<uint32_t> indices;
  for (int i = 0; i < 40; ++i) {
    for (const glm::vec3& corner : {glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)})
      positions.push_back(corner);
    for (int c = 0; c < 3; ++c) indices.push_back(uint32_t(indices.size()));
  }
  const Primitive same = triangles(positions, indices), other = same;
  const std::vector<const Primitive*> both{&same, &other};
  const NearestPlaces places(both);
  for (const glm::vec3& p : {glm::vec3(0.2f, 0.2f, 1), glm::vec3(-1, -1, 0), glm::vec3(2, 2, -3)}) {
    EXPECT_EQ(places.to(p).primitive, 0u);
    EXPECT_EQ(places.to(p).triangle, 0u);
  }
}

// A sliver beside a triangle counts for nothing, however near it is; alone it is all that there is; and of
// what has no area there is nothing.
TEST(NearestPlace, sliversCountWhereThereIsNothingElse) {
  const std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0, 0},        {0, 1, 0}, {5, 0, 0},
                                         {6, 0, 0}, {5.5f, 1e-6f, 0}, {9, 0, 0}};
  const Primitive both = triangles(positions, {3, 4, 5, 0, 1, 2}), sliver = triangles(positions, {3, 4, 5}),
                  line = triangles(positions, {3, 4, 6, 6, 6, 6}), none;
  EXPECT_EQ(NearestPlaces(std::vector<const Primitive*>{&both}).to({5.5f, 0, 0}).triangle, 1u);
  const NearestPlaces alone(std::vector<const Primitive*>{&sliver});
  ASSERT_FALSE(alone.isEmpty());
  EXPECT_NEAR(alone.to({5.25f, 3, 0}).mixed(positions).x, 5.25f, 1e-3f);
  EXPECT_TRUE(NearestPlaces(std::vector<const Primitive*>{&line}).isEmpty());
  EXPECT_TRUE(NearestPlaces(std::vector<const Primitive*>{&none}).isEmpty());
}

}  // namespace
}  // namespace scumble::scene
