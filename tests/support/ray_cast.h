// What a view sees of triangles, pixel by pixel, in double precision and without a rasteriser.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "scumble/view.h"
#include "tests/support/test_scene.h"

namespace scumble::test {

struct Ray {
  glm::dvec3 origin, direction;  // direction is unit
};
// Through the centre of a pixel.
Ray pixelRay(const View& view, int x, int y, int width, int height);

struct Hit {
  double distance = 0;          // along the ray, metres
  glm::dvec3 position, normal;  // the normal is interpolated and unit
  int id = 0;
  size_t triangle = 0;       // index into the list
  glm::dvec3 barycentric{};  // the shares of its corners
};
// The nearest triangle whose outside is hit, or any side with `bothSides`.
std::optional<Hit> castRay(const Ray& ray, const std::vector<WorldTriangle>& triangles,
                           bool bothSides = false);

// Where a point of the world lies in the picture, in pixels from its upper left corner.
glm::dvec2 pixelOf(const View& view, const glm::dvec3& world, int width, int height);

}  // namespace scumble::test
