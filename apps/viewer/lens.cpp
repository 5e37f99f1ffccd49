#include "lens.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace scumble::viewer {

namespace {

// Cosines below which a plane or an axis is seen so much from its edge that a pixel says nothing.
constexpr float kEdge = 0.02f;
constexpr float kQuarter = 1.5707963f;  // of a turn

}  // namespace

Lens::Lens(const View& view, const glm::vec2& window)
    : worldToClip_(view.eyeToClip * view.worldToEye),
      clipToWorld_(glm::inverse(glm::dmat4(view.worldToEye)) * glm::inverse(glm::dmat4(view.eyeToClip))),
      eyeToWorld_(glm::transpose(glm::mat3(view.worldToEye))),
      window_(window),
      origin_(view.origin) {
  for (int i = 0; i < 3; ++i) eyeToWorld_[i] = glm::normalize(eyeToWorld_[i]);
}

glm::dmat4 Lens::fromWorld() const {
  return glm::translate(glm::dmat4(1.0), -origin_);
}

std::optional<glm::vec2> Lens::pixelOf(const glm::vec3& place) const {
  const glm::vec4 clip = worldToClip_ * glm::vec4(place, 1);
  if (!(clip.w > 1e-9f)) return std::nullopt;
  return (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * window_;
}

Lens::Ray Lens::rayAt(const glm::vec2& pixel) const {
  const glm::vec2 clip = pixel / window_ * 2.0f - 1.0f;
  // Depth is reversed: 1 is near, and nearly 0 is far away.
  const auto at = [&](double depth) {
    const glm::dvec4 place = clipToWorld_ * glm::dvec4(clip, depth, 1);
    return glm::dvec3(place) / place.w;
  };
  const glm::dvec3 near = at(1), far = at(0.5);
  return {glm::vec3(near), glm::vec3(glm::normalize(far - near))};
}

float Lens::pixelSize(const glm::vec3& place) const {
  const std::optional<glm::vec2> here = pixelOf(place), beside = pixelOf(place + right());
  const float pixels = here && beside ? glm::distance(*here, *beside) : 0;
  return pixels > 0 ? 1 / pixels : 0;
}

glm::vec3 Lens::draggedFreely(const glm::vec3& place, const glm::vec2& pixel) const {
  const Ray ray = rayAt(pixel);
  return ray.from +
         ray.way * (glm::dot(place - ray.from, eyeToWorld_[2]) / glm::dot(ray.way, eyeToWorld_[2]));
}

std::optional<glm::vec3> Lens::draggedLevel(const glm::vec3& place, const glm::vec2& pixel) const {
  const Ray ray = rayAt(pixel);
  if (std::abs(ray.way.y) < kEdge) return std::nullopt;
  const float far = (place.y - ray.from.y) / ray.way.y;
  if (far <= 0) return std::nullopt;
  return ray.from + far * ray.way;
}

std::optional<glm::vec3> Lens::draggedAlong(const glm::vec3& place, const glm::vec3& axis,
                                            const glm::vec2& pixel) const {
  const Ray ray = rayAt(pixel);
  // The point of the axis that is nearest to the ray.
  const glm::vec3 apart = ray.from - place;
  const float cosine = glm::dot(ray.way, axis), square = 1 - cosine * cosine;
  if (square < kEdge) return std::nullopt;
  return place + axis * ((glm::dot(apart, axis) - cosine * glm::dot(apart, ray.way)) / square);
}

glm::vec2 Lens::discOf(const glm::vec3& direction) const {
  const glm::vec3 seen = glm::transpose(eyeToWorld_) * direction;
  const float beside = glm::length(glm::vec2(seen));
  if (!(beside > 0)) return seen.z < 0 ? glm::vec2(2, 0) : glm::vec2(0);
  return std::atan2(beside, seen.z) / kQuarter * glm::vec2(seen.x, -seen.y) / beside;
}

glm::vec3 Lens::directionAt(const glm::vec2& disc) const {
  const float beside = glm::length(disc), angle = kQuarter * std::min(beside, 2.0f);
  if (!(beside > 0)) return eyeToWorld_[2];
  const glm::vec2 way = std::sin(angle) * disc / beside;
  return glm::normalize(eyeToWorld_ * glm::vec3(way.x, -way.y, std::cos(angle)));
}

}  // namespace scumble::viewer
