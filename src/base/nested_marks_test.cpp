#include "base/nested_marks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace scumble {
namespace {

// What the scale set promises: halving a copy along either axis keeps all of its places.
TEST(NestedMarks, haveAPlaceWhereTheirCopiesAtHalfTheSizeHaveOne) {
  const std::vector<glm::dvec2> places = nestedPlaces();
  const auto has = [&](const glm::dvec2& wanted) {
    return std::any_of(places.begin(), places.end(), [&](const glm::dvec2& place) {
      const glm::dvec2 off = place - wanted;
      return glm::length(off - glm::round(off)) < 1e-9;
    });
  };
  EXPECT_GE(places.size(), 100u);
  for (const glm::dvec2& place : places) {
    EXPECT_TRUE(has(place * glm::dvec2(2, 1))) << place.x << ", " << place.y;
    EXPECT_TRUE(has(place * glm::dvec2(1, 2))) << place.x << ", " << place.y;
  }
  EXPECT_FALSE(has({0.123, 0.456}));
}

TEST(NestedMarks, coverTheirPlacesAndLeaveTheRestFree) {
  const Pixels marks = nestedMarks();
  ASSERT_EQ(marks.rgba.size(), size_t(4) * marks.width * marks.height);
  const auto at = [&](double u, double v) {
    const auto texel = [](double t, uint32_t size) { return std::min(uint32_t(t * size), size - 1); };
    return marks.rgba[4 * (size_t(texel(v, marks.height)) * marks.width + texel(u, marks.width))];
  };
  for (const glm::dvec2& place : nestedPlaces())
    EXPECT_GT(at(place.x, place.y), 128) << place.x << ", " << place.y;
  size_t covered = 0;
  for (size_t i = 0; i < marks.rgba.size(); i += 4) {
    covered += marks.rgba[i] > 127;
    EXPECT_EQ(marks.rgba[i], marks.rgba[i + 1]);
    EXPECT_EQ(marks.rgba[i], marks.rgba[i + 2]);
  }
  EXPECT_NEAR(double(covered) * 4 / double(marks.rgba.size()), 0.40, 0.02);
}

}  // namespace
}  // namespace scumble
