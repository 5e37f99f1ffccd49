#include "scene/splat_places.h"

#include <algorithm>
#include <cmath>

#include "base/tileable_noise.h"

namespace scumble::scene {

namespace {

// A stroke that tapers to nothing has splats as if it ended that wide, as a part of its widest place; and one
// that is hardly there, as if it were so wide, as a part of its length.
constexpr double kThinnest = 0.1, kHair = 1e-5;
// How much a splat at the end of a stroke counts: there is always one.
constexpr float kAlways = 1e30f;

// How long pieces of a stroke are, in radii of where they lie.
class StrokeRadii {
 public:
  StrokeRadii(const Painting& painting, const Stroke& stroke)
      : points_(painting.points.data() + stroke.firstPoint) {
    double widest = 0, length = 0;
    for (uint32_t i = 0; i < stroke.pointCount; ++i) widest = std::max(widest, double(points_[i].radius));
    for (uint32_t i = 0; i + 1 < stroke.pointCount; ++i) length += lengthOf(i);
    least_ = std::max(kThinnest * widest, kHair * length);
  }
  // Of the piece after a point.
  double operator()(uint32_t i) const {
    const double radius =
        0.5 * (std::max(double(points_[i].radius), least_) + std::max(double(points_[i + 1].radius), least_));
    return radius > 0 ? lengthOf(i) / radius : 0.0;
  }

 private:
  double lengthOf(uint32_t i) const {
    return glm::distance(glm::dvec3(points_[i].position), glm::dvec3(points_[i + 1].position));
  }
  const StrokePoint* points_;
  double least_ = 0;
};

}  // namespace

uint32_t strokeChance(size_t stroke) {
  return hash(uint32_t(stroke) * 2654435761u + 17u) & 0xFFFF;
}

std::vector<SplatPlace> splatPlaces(const Painting& painting, std::vector<float>& along, float least) {
  along.resize(painting.points.size());
  std::vector<SplatPlace> places;
  for (const Stroke& stroke : painting.strokes) {
    const StrokeRadii radiiOf(painting, stroke);
    places.push_back({stroke.firstPoint, 0, kAlways});
    // Every second splat counts more than those between, every fourth more than those, and so on.
    double at = 0;
    uint64_t number = 1;
    along[stroke.firstPoint] = 0;
    for (uint32_t i = 0; i + 1 < stroke.pointCount; ++i) {
      const double radii = radiiOf(i);
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

double splatCount(const Painting& painting, float least) {
  double count = 0;
  for (const Stroke& stroke : painting.strokes) {
    const StrokeRadii radiiOf(painting, stroke);
    double radii = 0;
    for (uint32_t i = 0; i + 1 < stroke.pointCount; ++i) radii += radiiOf(i);
    count += std::floor(radii / least);
  }
  return count;
}

}  // namespace scumble::scene
