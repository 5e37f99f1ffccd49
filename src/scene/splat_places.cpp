#include "scene/splat_places.h"

#include <algorithm>

namespace scumble::scene {

namespace {

// A stroke that tapers to nothing has splats as if it ended that wide, as a part of its widest place.
constexpr float kThinnest = 0.1f;
// How much a splat at the end of a stroke counts: there is always one.
constexpr float kAlways = 1e30f;

}  // namespace

std::vector<SplatPlace> splatPlaces(const Painting& painting, std::vector<float>& along, float least) {
  along.resize(painting.points.size());
  std::vector<SplatPlace> places;
  for (const Stroke& stroke : painting.strokes) {
    const StrokePoint* const points = painting.points.data() + stroke.firstPoint;
    float widest = 0;
    for (uint32_t i = 0; i < stroke.pointCount; ++i) widest = std::max(widest, points[i].radius);
    const auto radiusOf = [&](uint32_t i) { return std::max(points[i].radius, kThinnest * widest); };
    places.push_back({stroke.firstPoint, 0, kAlways});
    // Every second splat counts more than those between, every fourth more than those, and so on.
    double at = 0;
    uint64_t number = 1;
    along[stroke.firstPoint] = 0;
    for (uint32_t i = 0; i + 1 < stroke.pointCount; ++i) {
      const double length = glm::distance(points[i].position, points[i + 1].position);
      const double radii = length / (0.5 * (double(radiusOf(i)) + radiusOf(i + 1)));
      for (; double(number) * least < at + radii; ++number)
        places.push_back({stroke.firstPoint + i, float((double(number) * least - at) / radii),
                          least * float(number & (~number + 1))});
      at += radii;
      along[stroke.firstPoint + i + 1] = float(at);
    }
    // The last one lies at the end.
    if (at > 0) places.push_back({stroke.firstPoint + stroke.pointCount - 1, 0, kAlways});
  }
  return places;
}

}  // namespace scumble::scene
