#include "scene/painting.h"

#include <algorithm>
#include <cmath>

#include "scene/import_warnings.h"
#include "scene/posed_bounds.h"
#include "scene/prepare_mesh.h"

namespace scumble::scene {

namespace {

constexpr float kLargestRadius = 1e6f;  // metres

bool isFinite(const glm::vec4& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

}  // namespace

const char* nameOf(Brush brush) {
  static constexpr const char* kNames[] = {"plain", "bristles", "wash", "spatter", "light", "gaussian"};
  return kNames[size_t(brush)];
}

void Painting::add(Brush brush, std::vector<StrokePoint> added, const std::string& path,
                   ImportWarnings& warnings) {
  const size_t all = added.size();
  std::erase_if(added, [](const StrokePoint& p) {
    return !isDrawable(p.position) || !(p.radius > 0 && p.radius <= kLargestRadius) || !isFinite(p.color) ||
           !std::isfinite(p.time) || !isFinite(glm::vec4(p.shape, 1));
  });
  if (added.empty()) {
    warnings.add(path, all == 0 ? "a stroke without points is left out"
                                : "a stroke whose points are nowhere, or of no width, is left out");
    return;
  }
  if (added.size() < all) warnings.add(path, "points that are nowhere, or of no width, are left out");
  for (StrokePoint& p : added) {
    const float length = glm::length(p.orientation);
    p.orientation = std::isfinite(length) && length > 1e-6f ? p.orientation / length : glm::quat(1, 0, 0, 0);
    p.color = glm::clamp(p.color, 0.0f, 1.0f);
    p.shape = glm::clamp(p.shape, 0.0f, 1.0f);
  }
  strokes.push_back({uint32_t(points.size()), uint32_t(added.size()), brush});
  points.insert(points.end(), added.begin(), added.end());
}

void Painting::beginAtZero() {
  float first = points.empty() ? 0.0f : points[0].time;
  for (const StrokePoint& p : points) first = std::min(first, p.time);
  for (StrokePoint& p : points) p.time -= first;
}

void Painting::finish() {
  Bounds box;
  duration = 0;
  for (const StrokePoint& p : points) {
    box.add(p.position - p.radius);
    box.add(p.position + p.radius);
    hull.positions.push_back(p.position);
    duration = std::max(duration, p.time);
  }
  hull.extent = extentOf(hull);
  hull.extent.box = box;
  hull.positions = {};
}

}  // namespace scumble::scene
