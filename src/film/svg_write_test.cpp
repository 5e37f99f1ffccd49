// SVG: shapes are as wide as strokes, closed, and without holes where strokes turn.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <sstream>

#include "scumble/drawing.h"
#include "tests/support/stroke_distance.h"

namespace scumble {
namespace {

// Polygons of the paths of a document; arcs become lines.
std::vector<std::vector<glm::dvec2>> polygonsOf(const std::string& svg) {
  std::vector<std::vector<glm::dvec2>> polygons;
  for (size_t at = svg.find(" d=\""); at != std::string::npos; at = svg.find(" d=\"", at + 1)) {
    std::string path = svg.substr(at + 4, svg.find('"', at + 4) - at - 4);
    for (const char letter : {'M', 'L', 'A', 'Z'})
      for (size_t i = path.find(letter); i != std::string::npos; i = path.find(letter, i + 3))
        path.replace(i, 1, std::string(" ") + letter + " ");
    std::istringstream words(path);
    char command = 0;
    while (words >> command) {
      glm::dvec2 to;
      double skipped = 0, radius = 0;
      if (command == 'Z') continue;
      if (command == 'A') words >> radius >> skipped >> skipped >> skipped >> skipped;
      words >> to.x >> to.y;
      if (command == 'M') polygons.emplace_back();
      if (command == 'A') {
        // A point on top of the arc, clockwise around the middle.
        const glm::dvec2 from = polygons.back().back(), half = 0.5 * (to - from);
        const double rise = std::sqrt(std::max(radius * radius - glm::dot(half, half), 0.0));
        const glm::dvec2 up = glm::length(half) > 0 ? glm::dvec2(half.y, -half.x) / glm::length(half) : half;
        polygons.back().push_back(from + half + (radius - rise) * up);
      }
      polygons.back().push_back(to);
    }
  }
  return polygons;
}

// Around a place, over all of them: what fill-rule nonzero fills.
int windingOf(const std::vector<std::vector<glm::dvec2>>& polygons, glm::dvec2 p) {
  int winding = 0;
  for (const auto& polygon : polygons)
    for (size_t i = 0; i < polygon.size(); ++i) {
      const glm::dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      const double side = (b.x - a.x) * (p.y - a.y) - (p.x - a.x) * (b.y - a.y);
      if (a.y <= p.y && b.y > p.y && side > 0) ++winding;
      if (a.y > p.y && b.y <= p.y && side < 0) --winding;
    }
  return winding;
}

void expectShape(const Drawing::Stroke& stroke) {
  const auto polygons = polygonsOf(svgOf({60, 60, {stroke}}));
  int inside = 0;
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 120; ++x) {
      const glm::dvec2 place(0.5 * x + 0.123, 0.5 * y + 0.217);
      const double beyond = test::beyondStroke(stroke, place);
      const bool isFilled = windingOf(polygons, place) != 0;
      inside += isFilled;
      // Arcs are two lines here; widths change by up to the half along a part.
      if (std::abs(beyond) > 0.8) {
        EXPECT_EQ(isFilled, beyond < 0) << place.x << " " << place.y;
      }
    }
  EXPECT_GT(inside, 100);
}

TEST(SvgWrite, shapesAreStrokes) {
  expectShape({"a", {}, false, false, {{10, 10, 3}, {50, 20, 3}}});
  expectShape({"a", {}, false, false, {{10, 10, 1}, {30, 20, 4}, {50, 10, 2}, {52, 40, 3}}});
  // Sharp corners either way, and points on one another.
  expectShape({"a", {}, false, false, {{10, 30, 3}, {45, 30, 3}, {45, 30, 3}, {20, 45, 3}, {50, 50, 3}}});
  expectShape({"a", {}, false, false, {{10, 30, 3}, {45, 30, 3}, {20, 15, 3}, {50, 10, 3}}});
  // Closed, both ways round.
  expectShape({"a", {}, false, true, {{10, 10, 2}, {50, 10, 3}, {50, 50, 4}, {10, 50, 3}}});
  expectShape({"a", {}, false, true, {{10, 10, 2}, {10, 50, 3}, {50, 50, 4}, {50, 10, 3}}});
}

TEST(SvgWrite, layersAndLines) {
  Drawing drawing{60, 40, {}};
  drawing.strokes.push_back({"creases", {0, 0, 0}, false, false, {{1, 2, 1}, {3.5f, 4, 1}}});
  drawing.strokes.push_back({"silhouettes", {1, 0, 0}, false, false, {{1, 2, 1}, {30, 4, 1}}});
  drawing.strokes.push_back({"silhouettes", {1, 0, 0}, true, false, {{5, 2, 1}, {3, 4, 1}}});
  drawing.strokes.push_back({"creases", {0, 0, 0}, false, false, {{7, 7, 1}, {7, 7, 1}}});  // of no length
  const std::string plain = svgOf(drawing), lines = svgOf(drawing, {true, true});
  const auto count = [](const std::string& text, const std::string& part) {
    size_t found = 0;
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count(plain, "<path"), 2u);
  EXPECT_EQ(count(plain, "<g "), 2u);
  EXPECT_EQ(count(plain, "hidden"), 0u);
  EXPECT_EQ(count(plain, "fill=\"#ff0000\""), 1u);
  EXPECT_EQ(count(lines, "<path"), 3u);
  EXPECT_EQ(count(lines, "inkscape:label=\"silhouettes-hidden\""), 1u);
  EXPECT_EQ(count(lines, "stroke-dasharray"), 1u);
  EXPECT_EQ(count(lines, "d=\"M1 2L3.5 4\""), 1u);
  EXPECT_EQ(count(lines, "stroke-width=\"2\""), 3u);
  // Both eyes in one.
  const Drawing both = sideBySide(drawing, drawing), stacked = overUnder(drawing, drawing);
  EXPECT_EQ(both.width, 120u);
  EXPECT_EQ(both.strokes.size(), 8u);
  EXPECT_EQ(both.strokes[4].points[0].x, 61);
  EXPECT_EQ(stacked.height, 80u);
  EXPECT_EQ(stacked.strokes[4].points[0].y, 42);
}

}  // namespace
}  // namespace scumble
