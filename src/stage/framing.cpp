#include "stage/framing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "stage/camera.h"

namespace scumble::stage {

using scene::SceneData;

namespace {
constexpr float kFill = 2.0f / 3;  // of the frame's height or width, that the subject takes
constexpr int kSides = 72;         // from which a subject that is seen all around is looked at

// A direction's own axes, and half of what is seen at a distance of one, as far as it may be filled.
struct Window {
  glm::vec3 right, above, towards;
  glm::vec2 tangent;

  Window(const glm::vec3& direction, float verticalFov, float aspect) : towards(direction) {
    const glm::vec3 up = std::abs(direction.y) > 0.999f ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0);
    right = glm::normalize(glm::cross(up, direction));
    above = glm::cross(direction, right);
    tangent = std::tan(0.5f * verticalFov) * kFill * glm::vec2(aspect, 1.0f);
  }
  // Right, above, and towards the eye.
  glm::vec3 operator()(const glm::vec3& p) const {
    return {glm::dot(p, right), glm::dot(p, above), glm::dot(p, towards)};
  }
};
}  // namespace

int cameraNode(const SceneData& scene, size_t camera) {
  for (size_t n = 0; n < scene.nodes.size(); ++n)
    if (scene.nodes[n].camera == int(camera)) return int(n);
  return -1;
}

glm::vec3 orbitDirection(float azimuth, float elevation) {
  const float a = glm::radians(azimuth), e = glm::radians(elevation);
  return {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
}

glm::vec3 frontDirection(const SceneData& scene) {
  return orbitDirection(CameraParams().azimuth + (scene.facesBack ? 180 : 0), CameraParams().elevation);
}

glm::vec3 defaultEyeDirection(const SceneData& scene) {
  if (const int node = scene.cameras.empty() ? -1 : cameraNode(scene, 0); node >= 0) {
    const glm::vec3 backward(scene::worldMatrices(scene)[size_t(node)][2]);
    if (glm::length(glm::vec2(backward.x, backward.z)) > 1e-3f * glm::length(backward))
      return glm::normalize(backward);
  }
  return frontDirection(scene);
}

Framing framingOf(std::span<const glm::vec3> points, const glm::vec3& direction, float verticalFov,
                  float aspect) {
  if (points.empty()) return {glm::vec3(0.0f), 1.0f};
  scene::Bounds bounds;
  for (const glm::vec3& p : points) bounds.add(p);
  const Window window(direction, verticalFov, aspect);
  std::vector<glm::vec3> seen;
  for (const glm::vec3& p : points) seen.push_back(window(p - bounds.center()));

  // A point at (x, z) is inside of the frame around c where |x - c| <= tangent (distance - z); the least
  // distance has one at either side of the frame. Nobody stands among them, however wide the lens.
  float distance = 1e-6f;
  for (const glm::vec3& p : seen) distance = std::max(distance, p.z + 0.1f * bounds.radius());
  for (int axis = 0; axis < 2; ++axis) {
    float low = -std::numeric_limits<float>::infinity(), high = low;
    for (const glm::vec3& p : seen) {
      low = std::max(low, p.z - p[axis] / window.tangent[axis]);
      high = std::max(high, p.z + p[axis] / window.tangent[axis]);
    }
    distance = std::max(distance, 0.5f * (low + high));
  }
  // What takes less than the frame's other direction is in its middle as well.
  glm::vec3 target = bounds.center();
  for (int axis = 0; axis < 2; ++axis) {
    float low = -bounds.radius(), high = bounds.radius();
    for (int i = 0; i < 32; ++i) {
      const float middle = 0.5f * (low + high);
      float left = 0, right = 0;
      for (const glm::vec3& p : seen) {
        const float place = (p[axis] - middle) / std::max(distance - p.z, 1e-6f * distance);
        left = std::max(left, -place), right = std::max(right, place);
      }
      (right > left ? low : high) = middle;
    }
    target += 0.5f * (low + high) * (axis == 0 ? window.right : window.above);
  }
  return {target, distance};
}

float framingDistance(std::span<const glm::vec3> points, const glm::vec3& target, const glm::vec3& direction,
                      float verticalFov, float aspect) {
  const Window window(direction, verticalFov, aspect);
  float distance = 1e-6f;
  for (const glm::vec3& point : points) {
    const glm::vec3 p = window(point - target);
    distance =
        std::max({distance, std::abs(p.x) / window.tangent.x + p.z, std::abs(p.y) / window.tangent.y + p.z});
  }
  return distance;
}

float framingDistanceAllAround(std::span<const glm::vec3> points, const glm::vec3& target, float elevation,
                               float verticalFov, float aspect) {
  float distance = 0;
  for (int side = 0; side < kSides; ++side)
    distance = std::max(
        distance, framingDistance(points, target, orbitDirection(360.0f * float(side) / kSides, elevation),
                                  verticalFov, aspect));
  return distance;
}

}  // namespace scumble::stage
