#include "measure/reprojection.h"

#include <cmath>

namespace scumble::measuring {

namespace {

// Whether the surface at a place is the given point, away from edges: the four pixels around it,
// interpolated, and the depths of the 36 from which sampleAt would take its value.
bool showsPoint(const Surface& surface, float x, float y, const glm::vec3& point) {
  const float atX = x - 0.5f, atY = y - 0.5f;
  const float left = std::floor(atX), top = std::floor(atY);
  const Field &position = surface.position, &depth = surface.depth;
  if (!(left >= 2 && top >= 2 && left + 3 < float(position.width) && top + 3 < float(position.height)))
    return false;
  const size_t width = size_t(position.width), corner = size_t(top) * width + size_t(left);
  glm::vec3 there(0.0f);
  float depthThere = 0;
  for (size_t j = 0; j < 2; ++j)
    for (size_t i = 0; i < 2; ++i) {
      const size_t pixel = corner + j * width + i;
      const float weight = (i ? atX - left : 1 - (atX - left)) * (j ? atY - top : 1 - (atY - top));
      there += weight * glm::vec3(position.at(pixel)[0], position.at(pixel)[1], position.at(pixel)[2]);
      depthThere += weight * *depth.at(pixel);
    }
  const float footprint = surface.footprint(depthThere);
  if (!(glm::length(there - point) <= kSamePoint * footprint)) return false;
  for (size_t j = 0; j < 6; ++j)
    for (size_t i = 0; i < 6; ++i) {
      const size_t pixel = corner + j * width + i - 2 * width - 2;
      if (!position.valid[pixel] || std::abs(*depth.at(pixel) - depthThere) > kEdge * footprint) return false;
    }
  return true;
}

template <class PlaceOf>
Places placesOf(const Surface& here, const Surface& there, const PlaceOf& placeOf) {
  Places places(here.position.width, here.position.height, 2);
  for (size_t pixel = 0; pixel < places.pixelCount(); ++pixel) {
    if (!here.position.valid[pixel]) continue;
    const float* p = here.position.at(pixel);
    const glm::vec3 point(p[0], p[1], p[2]);
    const glm::vec2 place = placeOf(pixel, point);
    if (!showsPoint(there, place.x, place.y, point)) continue;
    places.at(pixel)[0] = place.x;
    places.at(pixel)[1] = place.y;
    places.valid[pixel] = 1;
  }
  return places;
}

}  // namespace

Places placesByMotion(const Field& motion, const Surface& now, const Surface& earlier) {
  const size_t width = size_t(motion.width);
  return placesOf(now, earlier, [&](size_t pixel, const glm::vec3&) {
    const size_t column = pixel % width, row = pixel / width;
    return glm::vec2(float(column) + 0.5f - motion.at(pixel)[0], float(row) + 0.5f - motion.at(pixel)[1]);
  });
}

Places placesByProjection(const Surface& here, const Surface& there, const glm::mat4& worldToClip) {
  const glm::vec2 size(float(there.position.width), float(there.position.height));
  return placesOf(here, there, [&](size_t, const glm::vec3& point) {
    const glm::vec4 clip = worldToClip * glm::vec4(point, 1.0f);
    if (!(clip.w > 0)) return glm::vec2(-1.0f);
    return (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * size;
  });
}

}  // namespace scumble::measuring
