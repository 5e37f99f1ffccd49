// Words of edges that are left out have no line, wherever they are seen from; and most are left out.
#include "features/ink/lines/edge_bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "features/ink/ink.shared.h"

namespace scumble::ink {
namespace {

// A ball of `side` times twice as many quads, whose places are shaken by a part of its radius.
scene::Primitive ball(int side, float shaken) {
  scene::Primitive p;
  std::mt19937 dice(3);
  std::uniform_real_distribution<float> shake(-shaken, shaken);
  for (int y = 0; y <= side; ++y)
    for (int x = 0; x < 2 * side; ++x) {
      const float down = 3.14159265f * float(y) / float(side), around = 3.14159265f * float(x) / float(side);
      const float radius = y == 0 || y == side ? 1 : 1 + shake(dice);
      p.positions.push_back(glm::vec3(2, -1, 3) + radius * glm::vec3(std::sin(down) * std::cos(around),
                                                                     std::cos(down),
                                                                     std::sin(down) * std::sin(around)));
    }
  const auto at = [&](int x, int y) { return uint32_t(y * 2 * side + x % (2 * side)); };
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < 2 * side; ++x)
      for (const uint32_t v :
           {at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)})
        p.indices.push_back(v);
  return p;
}

double sideOf(const scene::Primitive& p, uint32_t a, uint32_t b, uint32_t c, const glm::dvec4& eye) {
  const glm::dvec3 x = p.positions[a], y = p.positions[b], z = p.positions[c];
  return glm::dot(glm::cross(y - x, z - x), glm::dvec3(eye) - eye.w * x);
}

// Which part of the words is left out; none of them may have a silhouette.
double leftOut(const scene::Primitive& p, const glm::vec4& eye) {
  const std::vector<scene::MeshEdge> edges = inPatches(p, scene::edgesOf(p));
  EXPECT_EQ(edges.size(), scene::edgesOf(p).size());
  const std::vector<shared::EdgeBounds> bounds = boundsOf(p, edges);
  constexpr size_t kWord = size_t(shared::kInkThreads);
  EXPECT_EQ(bounds.size(), (edges.size() + kWord - 1) / kWord);
  size_t out = 0;
  for (size_t w = 0; w < bounds.size(); ++w) {
    if (!shared::allFaceAlike(bounds[w], eye)) continue;
    ++out;
    for (size_t e = w * kWord; e < std::min((w + 1) * kWord, edges.size()); ++e) {
      const scene::MeshEdge& edge = edges[e];
      if (edge.right == scene::MeshEdge::kNone) continue;
      const double left = sideOf(p, edge.a, edge.b, edge.left, eye),
                   right = sideOf(p, edge.b, edge.a, edge.right, eye);
      EXPECT_EQ(left < 0, right < 0) << "edge " << e;
    }
  }
  return double(out) / double(bounds.size());
}

TEST(EdgeBounds, whatIsLeftOutHasNoSilhouette) {
  const scene::Primitive smooth = ball(80, 0), rough = ball(80, 0.002f), wild = ball(40, 0.2f);
  std::mt19937 dice(5);
  std::normal_distribution<float> normal;
  for (const float distance : {1.02f, 1.3f, 3.0f, 50.0f})
    for (int i = 0; i < 6; ++i) {
      const glm::vec3 direction = glm::normalize(glm::vec3(normal(dice), normal(dice), normal(dice)));
      const glm::vec4 eye(glm::vec3(2, -1, 3) + distance * direction, 1);
      EXPECT_GT(leftOut(smooth, eye), 0.75) << distance;
      EXPECT_GT(leftOut(rough, eye), 0.5) << distance;
      leftOut(wild, eye);
      // Within it, all faces are seen from behind.
      if (distance > 40) {
        EXPECT_GT(leftOut(smooth, glm::vec4(direction, 0)), 0.75);
      }
    }
  EXPECT_GT(leftOut(smooth, {2, -1, 3, 1}), 0.9);
}

TEST(EdgeBounds, kindsAndAnglesAreThoseOfTheWord) {
  scene::Primitive p;
  // Two squares at a right angle, open all around.
  p.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}};
  p.indices = {0, 1, 3, 0, 3, 2, 1, 0, 4, 1, 4, 5};
  const std::vector<shared::EdgeBounds> bounds = boundsOf(p, scene::edgesOf(p));
  ASSERT_EQ(bounds.size(), 1u);
  EXPECT_EQ(bounds[0].kinds, shared::kEdgeOpen);
  EXPECT_NEAR(bounds[0].cosBend, 0, 1e-6);
  p.morphTargets.emplace_back();
  EXPECT_TRUE(boundsOf(p, scene::edgesOf(p)).empty());
}

}  // namespace
}  // namespace scumble::ink
