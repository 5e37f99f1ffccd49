#include "tests/support/ray_cast.h"

namespace scumble::test {

Ray pixelRay(const View& view, int x, int y, int width, int height) {
  const glm::dmat4 toWorld = glm::inverse(glm::dmat4(view.eyeToClip) * glm::dmat4(view.worldToEye));
  const glm::dvec2 ndc = (glm::dvec2(x, y) + 0.5) / glm::dvec2(width, height) * 2.0 - 1.0;
  // Depth is reversed: 1 is the near plane.
  const glm::dvec4 near = toWorld * glm::dvec4(ndc, 1, 1), far = toWorld * glm::dvec4(ndc, 0.5, 1);
  const glm::dvec3 origin = glm::dvec3(near) / near.w;
  return {origin, glm::normalize(glm::dvec3(far) / far.w - origin)};
}

std::optional<Hit> castRay(const Ray& ray, const std::vector<WorldTriangle>& triangles, bool bothSides) {
  std::optional<Hit> nearest;
  for (size_t i = 0; i < triangles.size(); ++i) {
    const WorldTriangle& t = triangles[i];
    if (!bothSides && glm::dot(t.outward, ray.direction) >= 0) continue;
    // Moeller and Trumbore 1997.
    const glm::dvec3 a = t.positions[1] - t.positions[0], b = t.positions[2] - t.positions[0];
    const glm::dvec3 p = glm::cross(ray.direction, b);
    const double det = glm::dot(a, p);
    if (det == 0) continue;
    const glm::dvec3 s = ray.origin - t.positions[0];
    const double u = glm::dot(s, p) / det;
    if (u < 0 || u > 1) continue;
    const glm::dvec3 q = glm::cross(s, a);
    const double v = glm::dot(ray.direction, q) / det;
    if (v < 0 || u + v > 1) continue;
    const double distance = glm::dot(b, q) / det;
    if (distance <= 1e-9 || (nearest && distance >= nearest->distance)) continue;
    nearest = Hit{distance,
                  ray.origin + distance * ray.direction,
                  glm::normalize((1 - u - v) * t.normals[0] + u * t.normals[1] + v * t.normals[2]),
                  t.id,
                  i,
                  {1 - u - v, u, v}};
  }
  return nearest;
}

glm::dvec2 pixelOf(const View& view, const glm::dvec3& world, int width, int height) {
  const glm::dvec4 clip = glm::dmat4(view.eyeToClip) * glm::dmat4(view.worldToEye) * glm::dvec4(world, 1);
  return (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(width, height);
}

}  // namespace scumble::test
