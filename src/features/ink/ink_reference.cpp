#include "features/ink/ink_reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "tests/support/ray_cast.h"

namespace scumble::ink {

test::Knobs linesOfWidth(const std::string& width, const test::Knobs& more) {
  test::Knobs knobs{{"ink.shown", "on"},
                    {"ink.least", width},
                    {"ink.greatest", width},
                    {"ink.placement", "centred"},
                    {"ink.fade", "0"},
                    {"ink.outer", "1"},
                    {"warp.amount", "0"},
                    {"ink.creases.shown", "off"},
                    {"ink.materials.shown", "off"},
                    {"ink.boundaries.shown", "off"}};
  knobs.insert(knobs.end(), more.begin(), more.end());
  return knobs;
}

using namespace test;

bool ReferenceEdge::isSilhouette(const glm::dvec3& eye) const {
  return !isOpen && (glm::dot(left, eye - a) < 0) != (glm::dot(right, eye - a) < 0);
}
bool ReferenceEdge::isSeen(const glm::dvec3& eye) const {
  return glm::dot(left, eye - a) > 0 || (!isOpen && glm::dot(right, eye - a) > 0);
}
double ReferenceEdge::angle() const {
  return isOpen ? 0 : std::acos(glm::clamp(glm::dot(left, right), -1.0, 1.0)) * 180 / 3.14159265358979;
}

std::vector<ReferenceEdge> referenceEdges(const std::vector<WorldTriangle>& triangles) {
  using Place = std::array<int64_t, 3>;
  const auto placeOf = [](const glm::dvec3& p) {
    return Place{std::llround(p.x * 1e6), std::llround(p.y * 1e6), std::llround(p.z * 1e6)};
  };
  std::map<std::pair<Place, Place>, ReferenceEdge> edges;
  for (const WorldTriangle& triangle : triangles)
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 &a = triangle.positions[i], &b = triangle.positions[(i + 1) % 3];
      const Place from = placeOf(a), to = placeOf(b);
      if (from == to || glm::length(triangle.outward) == 0) continue;
      const glm::dvec3 normal = glm::normalize(triangle.outward);
      if (const auto other = edges.find({to, from}); other != edges.end()) {
        other->second.right = normal;
        other->second.isOpen = false;
      } else {
        edges[{from, to}] = {a, b, normal, glm::dvec3(0.0), true};
      }
    }
  std::vector<ReferenceEdge> list;
  for (const auto& [key, edge] : edges) list.push_back(edge);
  return list;
}

Texels referenceLines(const std::vector<ReferenceEdge>& edges, const View& view, int width, int height,
                      const std::function<double(const ReferenceEdge&)>& radiusOf) {
  Texels lines(width, height);
  for (const ReferenceEdge& edge : edges) {
    const double radius = radiusOf(edge);
    if (radius <= 0) continue;
    const glm::dvec2 a = pixelOf(view, edge.a, width, height), b = pixelOf(view, edge.b, width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const glm::dvec2 at(x + 0.5, y + 0.5), along = b - a;
        const double t = glm::clamp(glm::dot(at - a, along) / glm::dot(along, along), 0.0, 1.0);
        const double away = glm::distance(at, a + t * along), drawn = std::max(radius, 0.5);
        double& coverage = lines.at(x, y).x;
        coverage = std::max(coverage, radius / drawn * glm::clamp(drawn - away + 0.5, 0.0, 1.0));
      }
  }
  return lines;
}

}  // namespace scumble::ink
