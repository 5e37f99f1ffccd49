#include "stage/framing.h"

#include <algorithm>
#include <cmath>

#include "stage/camera.h"

namespace scumble::stage {

using scene::SceneData;

namespace {
constexpr float kFill = 0.82f;  // of the frame that the subject may take
constexpr int kSides = 72;      // from which a subject that is seen all around is looked at
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

glm::vec3 defaultEyeDirection(const SceneData& scene) {
  if (const int node = scene.cameras.empty() ? -1 : cameraNode(scene, 0); node >= 0) {
    const glm::vec3 backward(scene::worldMatrices(scene)[size_t(node)][2]);
    if (glm::length(glm::vec2(backward.x, backward.z)) > 1e-3f * glm::length(backward))
      return glm::normalize(backward);
  }
  return orbitDirection(CameraParams().azimuth, CameraParams().elevation);
}

float framingDistance(const scene::Bounds& bounds, const glm::vec3& direction, float verticalFov,
                      float aspect) {
  const glm::vec3 up = std::abs(direction.y) > 0.999f ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0);
  const glm::vec3 right = glm::normalize(glm::cross(up, direction)), above = glm::cross(direction, right);
  const float tanY = std::tan(0.5f * verticalFov) * kFill, tanX = tanY * aspect;
  const glm::vec3 half = 0.5f * (bounds.max - bounds.min);
  float distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 p(corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y,
                      corner & 4 ? half.z : -half.z);
    const float depth = glm::dot(p, direction);
    distance = std::max(
        {distance, std::abs(glm::dot(p, right)) / tanX + depth, std::abs(glm::dot(p, above)) / tanY + depth});
  }
  return std::max(distance, 1e-6f);
}

float framingDistanceAllAround(const scene::Bounds& bounds, float elevation, float verticalFov,
                               float aspect) {
  float distance = 0;
  for (int side = 0; side < kSides; ++side)
    distance = std::max(distance, framingDistance(bounds, orbitDirection(360.0f * side / kSides, elevation),
                                                  verticalFov, aspect));
  return distance;
}

}  // namespace scumble::stage
