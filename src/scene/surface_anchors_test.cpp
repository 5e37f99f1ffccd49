// Anchors: spread over the surface by area, evenly at every scale, the sparser sets within the denser ones.
#include "scene/surface_anchors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace scumble::scene {
namespace {

// Squares of several sizes of triangles side by side: 4 x 4 metres in all.
Primitive unevenSquare() {
  Primitive mesh;
  const auto add = [&](glm::vec2 low, glm::vec2 size, int cells) {
    for (int y = 0; y < cells; ++y)
      for (int x = 0; x < cells; ++x) {
        const glm::vec2 step = size / float(cells), at = low + step * glm::vec2(x, y);
        const glm::vec2 corners[] = {at,        at + glm::vec2(step.x, 0), at + step, at,
                                     at + step, at + glm::vec2(0, step.y)};
        for (const glm::vec2& corner : corners) {
          mesh.indices.push_back(uint32_t(mesh.positions.size()));
          mesh.positions.push_back({corner, 0});
        }
      }
  };
  add({0, 0}, {2, 4}, 1);
  add({2, 0}, {2, 2}, 40);
  add({2, 2}, {2, 2}, 6);
  return mesh;
}

glm::vec3 placeOf(const Primitive& mesh, const SurfaceAnchor& anchor) {
  const glm::vec3 a = mesh.positions[anchor.a];
  return a + anchor.toB * (mesh.positions[anchor.b] - a) + anchor.toC * (mesh.positions[anchor.c] - a);
}

TEST(SurfaceAnchors, lieInTheirTrianglesAndFollowFromTheSeed) {
  const Primitive mesh = unevenSquare();
  const auto anchors = anchorsOf(mesh, 16000, 1);
  EXPECT_GT(anchors.size(), 250u);
  for (const SurfaceAnchor& anchor : anchors) {
    EXPECT_GE(anchor.toB, 0);
    EXPECT_GE(anchor.toC, 0);
    EXPECT_LE(anchor.toB + anchor.toC, 1.000001f);
    EXPECT_EQ(anchor.b, anchor.a + 1);
    EXPECT_EQ(anchor.c, anchor.a + 2);
  }
  EXPECT_TRUE(std::is_sorted(anchors.begin(), anchors.end(),
                             [](const auto& a, const auto& b) { return a.spacing > b.spacing; }));
  EXPECT_EQ(anchors, anchorsOf(mesh, 16000, 1));
  EXPECT_NE(anchors, anchorsOf(mesh, 16000, 2));
}

// What is there stays where more come.
TEST(SurfaceAnchors, ofFewerCandidatesAreTheFirstOnes) {
  const Primitive mesh = unevenSquare();
  const auto most = anchorsOf(mesh, 64000, 3);
  size_t before = 0;
  for (const uint32_t candidates : {10u, 16u, 100u, 777u, 4000u, 32000u}) {
    const auto anchors = anchorsOf(mesh, candidates, 3);
    ASSERT_LE(anchors.size(), most.size()) << candidates;
    EXPECT_TRUE(std::equal(anchors.begin(), anchors.end(), most.begin())) << candidates;
    EXPECT_GE(anchors.size(), before) << candidates;
    before = anchors.size();
  }
  EXPECT_GT(most.size(), 1.5 * double(before));
}

// Of any spacing: nobody is nearer, no place is farther from all than that, and there are as many in each
// part of the surface as its area says.
TEST(SurfaceAnchors, areEvenAtEveryScale) {
  const Primitive mesh = unevenSquare();
  const auto anchors = anchorsOf(mesh, 32000, 5);
  for (const float spacing : {0.9f, 0.45f, 0.22f, 0.12f}) {
    std::vector<glm::vec3> places;
    for (const SurfaceAnchor& anchor : anchors)
      if (anchor.spacing >= spacing) places.push_back(placeOf(mesh, anchor));
    float nearest = 100;
    for (size_t i = 0; i < places.size(); ++i)
      for (size_t j = 0; j < i; ++j) nearest = std::min(nearest, glm::distance(places[i], places[j]));
    // Within a level, the last ones are as near as its end.
    EXPECT_GE(nearest, 0.70f * spacing) << spacing;
    const double ofSquare = double(places.size()) * spacing * spacing / 16;
    EXPECT_GT(ofSquare, 0.45) << spacing;
    EXPECT_LT(ofSquare, 1.35) << spacing;
    if (places.size() < 100) continue;
    const auto left = std::count_if(places.begin(), places.end(), [](const glm::vec3& p) { return p.x < 2; });
    EXPECT_NEAR(double(left) / double(places.size()), 0.5, 0.06) << spacing;
  }
}

TEST(SurfaceAnchors, ofNothingAreNone) {
  Primitive flat;
  flat.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  flat.indices = {0, 1, 2};
  EXPECT_TRUE(anchorsOf(flat, 1000, 1).empty());
  EXPECT_TRUE(anchorsOf(Primitive(), 1000, 1).empty());
  EXPECT_TRUE(anchorsOf(unevenSquare(), 0, 1).empty());
}

// Both sides of a thin sheet have their own.
TEST(SurfaceAnchors, sidesOfASheetDoNotKnowOfEachOther) {
  Primitive sheet = unevenSquare();
  const size_t one = anchorsOf(sheet, 16000, 1).size(), corners = sheet.indices.size();
  for (size_t i = 0; i < corners; i += 3)
    for (const size_t corner : {0u, 2u, 1u}) sheet.indices.push_back(sheet.indices[i + corner]);
  const size_t both = anchorsOf(sheet, 32000, 1).size();
  EXPECT_NEAR(double(both), 2.0 * double(one), 0.2 * double(one));
}

}  // namespace
}  // namespace scumble::scene
