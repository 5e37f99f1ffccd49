// Fog and falloff of the volumes' unit shapes, in closed form; C++ and GLSL compile the same text, so that
// tests can put numbers to it.
//
// All is in the space in which the shape is a unit shape: `eye`, the direction `ray` of length 1, and `way`,
// how far it goes before it meets a surface. Densities are 1 at the centre and 0 at the edge. Fog is the
// density along the way, divided by what a way through the whole shape along an axis gathers, which is 4/3.
#ifndef SCUMBLE_FOG_SHARED_H
#define SCUMBLE_FOG_SHARED_H
#include "../../shading/shared_types.h"

#ifdef __cplusplus
namespace scumble::shared {
using glm::abs;
using glm::clamp;
using glm::dot;
using glm::exp2;
using glm::max;
using glm::min;
using glm::sqrt;
}  // namespace scumble::shared
#endif

SHARED_BEGIN

// The integral of h - x^2 from `low` to `high`, as far as that is positive.
SHARED_FUNCTION float parabola(float h, float low, float high) {
  float w = sqrt(max(h, 0.0f));
  float a = clamp(low, -w, w), b = clamp(high, -w, w);
  return (b - a) * (h - (a * a + a * b + b * b) * (1.0f / 3.0f));
}

// Density 1 - |q|^2, from the point of the ray that is nearest to the centre: with the distances of far eyes
// squared, as the paper has it (002), small spheres drown in rounding.
SHARED_FUNCTION float sphereBetween(vec3 eye, vec3 ray, float from, float to) {
  float b = dot(eye, ray);
  vec3 nearest = eye - b * ray;
  return parabola(1.0f - dot(nearest, nearest), b + from, b + to);
}
SHARED_FUNCTION float sphereFog(vec3 eye, vec3 ray, float way) {
  return 0.75f * sphereBetween(eye, ray, 0.0f, way);
}
SHARED_FUNCTION float sphereDensity(vec3 at) {
  return max(1.0f - dot(at, at), 0.0f);
}

// Density (1 - x^2) (1 - y^2) (1 - z^2), of degree 6 along a ray: Gauss's rule of four points is exact.
SHARED_FUNCTION float boxDensityAt(vec3 q) {
  return (1.0f - q.x * q.x) * (1.0f - q.y * q.y) * (1.0f - q.z * q.z);
}
SHARED_FUNCTION float boxFog(vec3 eye, vec3 ray, float way) {
  // An axis to which the ray is parallel is crossed very far away.
  vec3 inverse = vec3(1.0f / (ray.x < 0.0f ? min(ray.x, -1e-8f) : max(ray.x, 1e-8f)),
                      1.0f / (ray.y < 0.0f ? min(ray.y, -1e-8f) : max(ray.y, 1e-8f)),
                      1.0f / (ray.z < 0.0f ? min(ray.z, -1e-8f) : max(ray.z, 1e-8f)));
  vec3 a = (vec3(-1.0f) - eye) * inverse, b = (vec3(1.0f) - eye) * inverse;
  vec3 enter = min(a, b), leave = max(a, b);
  float from = max(max(max(enter.x, enter.y), enter.z), 0.0f);
  float to = min(min(min(leave.x, leave.y), leave.z), way);
  float halfWay = 0.5f * max(to - from, 0.0f);
  vec3 middle = clamp(eye + (from + halfWay) * ray, vec3(-1.0f), vec3(1.0f));
  vec3 inner = (0.3399810436f * halfWay) * ray, outer = (0.8611363116f * halfWay) * ray;
  float sum = 0.6521451549f * (boxDensityAt(middle - inner) + boxDensityAt(middle + inner)) +
              0.3478548451f * (boxDensityAt(middle - outer) + boxDensityAt(middle + outer));
  return 0.75f * halfWay * max(sum, 0.0f);
}
SHARED_FUNCTION float boxDensity(vec3 at) {
  vec3 d = max(vec3(1.0f) - at * at, vec3(0.0f));
  return d.x * d.y * d.z;
}

// Density 1 - distance^2 from an axis that goes from -axis to +axis along y: a sphere's below and above it, a
// cylinder's between.
SHARED_FUNCTION float capsuleFog(vec3 eye_, vec3 ray_, float way, float axis) {
  // Turned over so that the ray climbs.
  float turn = ray_.y < 0.0f ? -1.0f : 1.0f;
  vec3 eye = vec3(eye_.x, eye_.y * turn, eye_.z), ray = vec3(ray_.x, ray_.y * turn, ray_.z);
  float climb = 1.0f / max(ray.y, 1e-8f);
  float up = clamp((-axis - eye.y) * climb, 0.0f, way), down = clamp((axis - eye.y) * climb, 0.0f, way);
  float fog = sphereBetween(eye + vec3(0.0f, axis, 0.0f), ray, 0.0f, up) +
              sphereBetween(eye - vec3(0.0f, axis, 0.0f), ray, down, way);
  // The cylinder: its density is a parabola of the way, for which Simpson's rule is exact; written so, a ray
  // along the axis is as good as any.
  float k2 = max(ray.x * ray.x + ray.z * ray.z, 1e-12f);
  float b = (eye.x * ray.x + eye.z * ray.z) / k2;
  float nearX = eye.x - b * ray.x, nearZ = eye.z - b * ray.z;
  float w = sqrt(max(1.0f - nearX * nearX - nearZ * nearZ, 0.0f) / k2);
  float from = clamp(up, -b - w, -b + w), to = clamp(down, -b - w, -b + w);
  float middle = 0.5f * (from + to);
  float x0 = eye.x + from * ray.x, x1 = eye.x + middle * ray.x, x2 = eye.x + to * ray.x;
  float z0 = eye.z + from * ray.z, z1 = eye.z + middle * ray.z, z2 = eye.z + to * ray.z;
  float mean = 1.0f - (x0 * x0 + z0 * z0 + 4.0f * (x1 * x1 + z1 * z1) + x2 * x2 + z2 * z2) * (1.0f / 6.0f);
  return 0.75f * (fog + (to - from) * max(mean, 0.0f));
}
SHARED_FUNCTION float capsuleDensity(vec3 at, float axis) {
  return sphereDensity(vec3(at.x, at.y - clamp(at.y, -axis, axis), at.z));
}

// What of light is lost in fog of this optical depth.
SHARED_FUNCTION float saturated(float depth) {
  return 1.0f - exp2(-1.44269504f * depth);
}

// Density -y below the plane y = 0, and none above it.
SHARED_FUNCTION float halfSpaceFog(vec3 eye, vec3 ray, float way) {
  float y0 = eye.y, y1 = eye.y + way * ray.y;
  float d0 = max(-y0, 0.0f), d1 = max(-y1, 0.0f);
  float below = max(y0, y1) <= 0.0f ? 1.0f : abs(d1 - d0) / max(abs(y1 - y0), 1e-20f);  // part of the way
  return saturated(0.5f * (d0 + d1) * way * below);
}
SHARED_FUNCTION float halfSpaceDensity(vec3 at) {
  return saturated(max(-at.y, 0.0f));
}

SHARED_END
#endif
