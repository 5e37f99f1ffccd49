// Points all over triangles, the same ones at each call.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace scumble::scene {

struct SurfacePoint {
  std::array<uint32_t, 3> corners;  // vertices
  glm::dvec3 weights;               // their shares
  glm::dvec3 normal;                // of the triangle; its length is the area that the point stands for
  template <class Values>
  auto operator()(const Values& of) const {
    return weights.x * of(corners[0]) + weights.y * of(corners[1]) + weights.z * of(corners[2]);
  }
};

// About so many, at least one where there are triangles. `positionOf`: a vertex's, by its number.
template <class PositionOf, class Body>
void forEachSurfacePoint(std::span<const uint32_t> indices, const PositionOf& positionOf, size_t points,
                         const Body& body) {
  const size_t triangles = indices.size() / 3;
  if (triangles == 0) return;
  // Some points of each, or a part of the triangles, in no order: every so many might all be of one kind.
  const size_t each = std::max<size_t>(1, points / triangles), chosen = std::min(triangles, points);
  for (size_t n = 0; n < chosen; ++n) {
    const size_t t = triangles <= points ? n : n * 2654435761u % triangles;
    SurfacePoint point;
    for (size_t k = 0; k < 3; ++k) point.corners[k] = indices[3 * t + k];
    const glm::dvec3 a(positionOf(point.corners[0])), b(positionOf(point.corners[1])),
        c(positionOf(point.corners[2]));
    point.normal = 0.5 * glm::cross(b - a, c - a) * (double(triangles) / double(chosen * each));
    if (!std::isfinite(glm::length(point.normal)) || !(glm::length(point.normal) > 0)) continue;
    for (size_t i = 0; i < each; ++i) {
      // Evenly spread (Roberts' R2 sequence, folded); the first one is the middle.
      glm::dvec2 at(1.0 / 3);
      if (i > 0) {
        at = glm::fract(0.5 + double(i) * glm::dvec2(0.7548776662466927, 0.5698402909980532));
        if (at.x + at.y > 1) at = 1.0 - at;
      }
      point.weights = {1 - at.x - at.y, at.x, at.y};
      body(point);
    }
  }
}

}  // namespace scumble::scene
