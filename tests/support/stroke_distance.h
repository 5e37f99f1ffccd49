// How far a place is from a stroke of a drawing.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>

#include "scumble/drawing.h"

namespace scumble::test {

// Beyond its edge, pixels; within it below 0.
inline double beyondStroke(const Drawing::Stroke& stroke, const glm::dvec2& place) {
  double nearest = 1e9;
  const size_t n = stroke.points.size();
  for (size_t i = 0; i + (stroke.isClosed ? 0 : 1) < n; ++i) {
    const Drawing::Point &a = stroke.points[i], &b = stroke.points[(i + 1) % n];
    const glm::dvec2 from(a.x, a.y), way(b.x - a.x, b.y - a.y);
    const double t = glm::clamp(glm::dot(place - from, way) / std::max(glm::dot(way, way), 1e-9), 0.0, 1.0);
    nearest = std::min(nearest, glm::length(place - from - t * way) - glm::mix(a.radius, b.radius, t));
  }
  return nearest;
}

}  // namespace scumble::test
