#include "features/painting/bindings.h"

#include <algorithm>
#include <cmath>

#include "scene/nearest_place.h"
#include "scene/parallel.h"

namespace scumble::painting {

namespace {

PointBinding bound(const scene::StrokePoint& point, const scene::NearestPlaces::Place& place,
                   const scene::Primitive& primitive) {
  const glm::vec3 &a = primitive.positions[place.vertices.x], &b = primitive.positions[place.vertices.y],
                  &c = primitive.positions[place.vertices.z];
  const glm::vec3 face = glm::cross(b - a, c - a);
  glm::vec3 normal = place.mixed(primitive.normals);
  normal = glm::dot(normal, normal) > 1e-12f ? glm::normalize(normal) : glm::normalize(face);
  glm::vec3 edge = b - a;
  edge -= normal * glm::dot(normal, edge);
  edge *= 1 / std::sqrt(std::max(glm::dot(edge, edge), 1e-30f));
  // On the side that a mirrored triangle has mirrored, too.
  const float hand = glm::dot(face, normal) < 0 ? -1.0f : 1.0f;
  const glm::mat3 toFrame = glm::transpose(glm::mat3(edge, hand * glm::cross(normal, edge), normal));
  PointBinding binding;
  binding.primitive = place.primitive;
  binding.vertices = place.vertices;
  binding.at = place.at;
  binding.size = std::sqrt(glm::length(face));
  binding.offset = toFrame * (point.position - place.mixed(primitive.positions));
  return binding;
}

}  // namespace

std::vector<PointBinding> bindPoints(const scene::Painting& painting,
                                     std::span<const scene::Primitive* const> primitives) {
  const scene::NearestPlaces places(primitives);
  if (places.isEmpty()) return {};
  std::vector<PointBinding> bindings(painting.points.size());
  constexpr size_t kBlock = 1024;
  scene::parallelFor((bindings.size() + kBlock - 1) / kBlock, scene::threadCount(0), [&](size_t block) {
    for (size_t i = block * kBlock; i < std::min(bindings.size(), (block + 1) * kBlock); ++i) {
      const scene::NearestPlaces::Place place = places.to(painting.points[i].position);
      bindings[i] = bound(painting.points[i], place, *primitives[place.primitive]);
    }
  });
  return bindings;
}

}  // namespace scumble::painting
