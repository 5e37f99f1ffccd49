// The inside of vessels, against their forms.
#include "features/ocean/hulls/hull_field.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "features/ocean/hulls/hull_shapes.h"
#include "shading/cutouts.shared.h"

namespace scumble::ocean {
namespace {

using test::HullShape;

std::vector<Triangle> hullTriangles(const HullShape& shape, const glm::mat4& matrix = glm::mat4(1)) {
  std::vector<Triangle> triangles;
  const auto at = [&](size_t i) {
    return glm::vec3(matrix * glm::vec4(shape.positions[shape.indices[i]], 1));
  };
  for (size_t i = 0; i < shape.indices.size(); i += 3) triangles.push_back({at(i), at(i + 1), at(i + 2)});
  return triangles;
}

// As shading/cutouts.glsl has it, below the rim: cells.
double withinAt(const HullField& field, const glm::vec3& place) {
  const glm::dvec3 at = glm::vec3(field.toPoints * glm::vec4(place, 1));
  const glm::dvec3 last = glm::dvec3(field.size) - 1.0;
  if (glm::any(glm::lessThan(at, glm::dvec3(0))) || at.x > last.x || at.z > last.z) return -1.5;
  const glm::ivec3 from = glm::clamp(at, glm::dvec3(0), last - 1.0);
  const glm::dvec3 f = glm::clamp(at - glm::dvec3(from), 0.0, 1.0);
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
    const glm::dvec3 share = glm::mix(1.0 - f, f, glm::dvec3(step));
    sum += share.x * share.y * share.z * field.at(from + step);
  }
  return sum / 127 * double(shared::kCutoutReach);
}
double cellOf(const HullField& field) {
  return 1.0 / double(glm::length(glm::vec3(field.toPoints[0])));
}

// Every place inside is found to be, and no place outside by more than half a cell, at all heights below the
// rim.
TEST(HullField, isTheInsideOfTheForm) {
  for (const HullShape& shape : test::vesselShapes())
    for (const float yaw : {0.0f, 37.0f, 122.0f}) {
      const glm::mat4 turn = glm::rotate(glm::mat4(1), glm::radians(yaw), glm::vec3(0, 1, 0));
      const std::optional<HullField> field = findHull(hullTriangles(shape, turn));
      ASSERT_TRUE(field) << shape.name;
      EXPECT_LT(cellOf(*field), 0.09) << shape.name;
      size_t inside = 0, missed = 0, outside = 0, wrong = 0;
      const float away = float(cellOf(*field));
      for (float x = -3.2f; x < 3.2f; x += 0.047f)
        for (float z = -1.6f; z < 1.6f; z += 0.041f)
          for (const float y : {-0.15f, -0.05f, 0.05f, 0.15f, 0.22f}) {
            const glm::vec3 place(x, y, z);
            const double within = withinAt(*field, turn * glm::vec4(place, 1));
            if (shape.isInside(place, 0.004f)) {
              ++inside;
              missed += within <= -double(shared::kCutoutMargin);
            } else if (!shape.isInside(place, -shape.slack * away)) {
              ++outside;
              wrong += within > 0;
            }
          }
      EXPECT_GT(inside, 2000u) << shape.name;
      EXPECT_GT(outside, 2000u) << shape.name;
      EXPECT_EQ(missed, 0u) << shape.name << " turned by " << yaw << ", of " << inside;
      EXPECT_EQ(wrong, 0u) << shape.name << " turned by " << yaw << ", of " << outside;
      EXPECT_FALSE(field->rim.empty());
    }
}

TEST(HullField, isNotThereWhereNothingHoldsWater) {
  for (const HullShape& shape : test::leakyShapes())
    EXPECT_FALSE(findHull(hullTriangles(shape))) << shape.name;
  // Nor in a vessel upside down.
  for (const HullShape& shape : test::vesselShapes())
    EXPECT_FALSE(findHull(hullTriangles(shape, glm::scale(glm::mat4(1), {1, -1, 1})))) << shape.name;
}

// A hole in the bottom lets the sea in.
TEST(HullField, aHullWithAHoleIsNone) {
  HullShape dory = test::doryShape();
  std::vector<Triangle> triangles = hullTriangles(dory);
  std::erase_if(triangles, [](const Triangle& t) {
    const glm::vec3 middle = (t.a + t.b + t.c) / 3.0f;
    return middle.y < -0.2f && std::abs(middle.x) < 0.4f;
  });
  EXPECT_LT(triangles.size(), dory.indices.size() / 3);
  EXPECT_FALSE(findHull(triangles));
}

// What is stretched, mirrored, larger or smaller holds as much.
TEST(HullField, followsTheScale) {
  for (const glm::vec3& scale :
       {glm::vec3(0.01f), glm::vec3(40), glm::vec3(-1, 1, 1), glm::vec3(1, 2, 0.7f)}) {
    const std::optional<HullField> field =
        findHull(hullTriangles(test::doryShape(), glm::scale(glm::mat4(1), scale)));
    ASSERT_TRUE(field) << scale.x;
    EXPECT_GT(withinAt(*field, glm::vec3(0.4f, 0, 0.1f) * scale), 1) << scale.x;
    EXPECT_LT(withinAt(*field, glm::vec3(0.4f, 0, 1.2f) * scale), -1) << scale.x;
  }
}

TEST(HullField, isTheSameEachTime) {
  const std::vector<Triangle> triangles = hullTriangles(test::coracleShape());
  const std::optional<HullField> a = findHull(triangles), b = findHull(triangles);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->within, b->within);
  EXPECT_EQ(a->toPoints, b->toPoints);
}

// An artist's own is all that is within it, open to nothing.
TEST(HullField, fillsWhatAnArtistSays) {
  HullShape box{"inside", {}, {}};
  box.box({-2, -0.3f, -0.8f}, {2, 0.6f, 0.8f});
  const std::optional<HullField> field = fillHull(hullTriangles(box));
  ASSERT_TRUE(field);
  for (float x = -2.6f; x < 2.6f; x += 0.05f)
    for (float y = -0.5f; y < 0.8f; y += 0.05f) {
      const glm::vec3 away = glm::abs(glm::vec3(x, y - 0.15f, 0)) - glm::vec3(2, 0.45f, 0.8f);
      const float outside = std::max(away.x, away.y);
      const double within = withinAt(*field, {x, y, 0});
      if (outside < -0.01f) {
        EXPECT_GT(within, -0.25) << x << " " << y;
      }
      if (outside > 0.08f) {
        EXPECT_LT(within, 0) << x << " " << y;
      }
    }
  EXPECT_FALSE(fillHull(hullTriangles(test::leakyShapes()[1]))) << "a tube";
}

// Hostile input: nothing, no extent, numbers that are none, more than can be looked through.
TEST(HullField, boundsWhatItLooksThrough) {
  EXPECT_FALSE(findHull({}));
  EXPECT_FALSE(findHull(std::vector<Triangle>(3, Triangle{glm::vec3(1), glm::vec3(1), glm::vec3(1)})));
  std::vector<Triangle> odd = hullTriangles(test::doryShape());
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  for (const float x : {nan, inf, 1e30f}) odd.push_back({{x, 0, 0}, {0, x, 0}, {0, 0, -x}});
  EXPECT_TRUE(findHull(odd));
  std::vector<Triangle> many;
  for (int i = 0; i < 30000; ++i) {
    const float t = float(i) * 1e-5f;
    many.push_back({{-2 + t, -1, -1}, {2, 1, 1 - t}, {-2, 1, 1}});
  }
  EXPECT_FALSE(findHull(many));
}

}  // namespace
}  // namespace scumble::ocean
