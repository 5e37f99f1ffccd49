#include "frame/framing.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "frame/playing.h"
#include "scene/posed_bounds.h"
#include "scumble/view.h"

namespace scumble {

using scene::SceneData;

namespace frame {

namespace {
constexpr float kDefaultAzimuth = 32,
                kDefaultElevation = 14;  // degrees: three-quarter view, slightly from above
constexpr float kDefaultFov = 34;        // degrees, vertical
constexpr float kFill = 0.82f;           // of the frame that the subject may take
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
  return orbitDirection(kDefaultAzimuth, kDefaultElevation);
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

}  // namespace frame

glm::mat4 perspectiveProjection(float verticalFov, float aspect, float near) {
  const float f = 1.0f / std::tan(0.5f * verticalFov);
  glm::mat4 p(0.0f);
  p[0][0] = f / aspect;
  p[1][1] = -f;  // y down
  p[2][3] = -1;
  p[3][2] = near;
  return p;
}

glm::mat4 orthographicProjection(float halfHeight, float aspect, float near, float far) {
  glm::mat4 p(1.0f);
  p[0][0] = 1 / (halfHeight * aspect);
  p[1][1] = -1 / halfHeight;
  p[2][2] = 1 / (far - near);  // z is negative in front: 1 at near, 0 at far
  p[3][2] = far / (far - near);
  return p;
}

namespace {

Error badViewpoint(std::string problem, std::string advice) {
  return {ErrorKind::usage, "", 0, "", std::move(problem), std::move(advice)};
}

// Turns and places beyond which floats tell neighbouring ones no longer apart.
constexpr float kMostDegrees = 36000, kMostRadii = 1e6f, kMostMetres = 1e15f, kMostIpd = 1e6f;

Status checkRanges(const Viewpoint& viewpoint, float ipd) {
  const auto isBeyond = [](float number, float most) { return !(std::abs(number) <= most); };
  if (isBeyond(viewpoint.roll, kMostDegrees))
    return badViewpoint("the roll is out of range", "it is in degrees, up to a hundred turns");
  if (!(ipd >= 0 && ipd <= kMostIpd))
    return badViewpoint("the distance between the eyes (ipd) is out of range",
                        "it is in metres, 0 to a million");
  if (isBeyond(viewpoint.azimuth, kMostDegrees))
    return badViewpoint("the orbit's azimuth is out of range", "it is in degrees, up to a hundred turns");
  if (isBeyond(viewpoint.elevation, 90))
    return badViewpoint("the orbit's elevation is out of range", "it is -90 to 90 degrees");
  if (viewpoint.distance && !(*viewpoint.distance > 0 && *viewpoint.distance <= kMostRadii))
    return badViewpoint("the orbit's distance is out of range",
                        "it is in scene radii, above 0 and up to a million");
  for (const auto& point : {viewpoint.eye, viewpoint.target})
    for (int axis = 0; axis < 3; ++axis)
      if (point && isBeyond((*point)[axis], kMostMetres))
        return badViewpoint("the eye or its target is out of range", "they are in metres, up to 1e15");
  return Done{};
}

// Index of the camera with this name, or with this number.
std::optional<size_t> findCamera(const SceneData& scene, const std::string& name) {
  for (size_t i = 0; i < scene.cameras.size(); ++i)
    if (scene.cameras[i].name == name) return i;
  if (!name.empty() && name.size() < 7 &&
      std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; }))
    if (const size_t number = size_t(std::stoul(name)); number < scene.cameras.size()) return number;
  return std::nullopt;
}

View lookAt(const glm::vec3& eye, const glm::vec3& target, float rollDegrees) {
  const glm::vec3 forward = glm::normalize(target - eye);
  const glm::vec3 up = std::abs(forward.y) > 0.999f ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0);
  View view;
  view.worldToEye = glm::lookAt(eye, target, up);
  view.worldToEye =
      glm::rotate(glm::mat4(1.0f), glm::radians(rollDegrees), glm::vec3(0, 0, 1)) * view.worldToEye;
  return view;
}

}  // namespace

Result<std::vector<View>> makeViews(const Scene& scene, const Viewpoint& viewpoint, float aspect,
                                    Stereo stereo, float ipd, const Look& look, double time) {
  using namespace frame;
  if (scene.empty()) return badViewpoint("the scene is empty", "load one with Scene::load");
  const SceneData& data = scene.data();
  float fov = glm::radians(viewpoint.verticalFov.value_or(kDefaultFov));
  if (!(fov > 0.001f && fov < 3.1f))
    return badViewpoint("a field of view of that size sees nothing", "use 1 to 170 degrees");
  if (!(aspect > 0)) return badViewpoint("the picture has no area", "give a size like 1280x720");
  if (const Status status = checkRanges(viewpoint, ipd); !status) return status.error();

  View view;
  if (viewpoint.eye || viewpoint.target || viewpoint.orbit ||
      (viewpoint.camera.empty() && data.cameras.empty())) {
    const scene::Bounds bounds = scene::playedBounds(data, everPlayed(data, look.data()));
    const float radius = std::max(bounds.radius(), 1e-6f), near = 1e-3f * radius;
    if (viewpoint.eye || viewpoint.target) {
      const glm::vec3 target = viewpoint.target.value_or(bounds.center());
      const glm::vec3 eye =
          viewpoint.eye.value_or(target + framingDistance(bounds, defaultEyeDirection(data), fov, aspect) *
                                              defaultEyeDirection(data));
      if (glm::length(target - eye) < 1e-9f * radius)
        return badViewpoint("the eye stands on its target", "move one of them");
      view = lookAt(eye, target, viewpoint.roll);
      view.eyeToClip = perspectiveProjection(fov, aspect, std::min(near, 0.1f * glm::length(target - eye)));
    } else {
      const glm::vec3 direction = viewpoint.orbit ? orbitDirection(viewpoint.azimuth, viewpoint.elevation)
                                                  : orbitDirection(kDefaultAzimuth, kDefaultElevation);
      const float distance =
          viewpoint.distance ? *viewpoint.distance * radius : framingDistance(bounds, direction, fov, aspect);
      view = lookAt(bounds.center() + distance * direction, bounds.center(), viewpoint.roll);
      view.eyeToClip = perspectiveProjection(fov, aspect, std::min(near, 0.1f * distance));
    }
  } else {
    const std::optional<size_t> index = viewpoint.camera.empty() ? 0 : findCamera(data, viewpoint.camera);
    if (!index) {
      std::string names;
      for (size_t i = 0; i < data.cameras.size(); ++i)
        names +=
            (i == 0 ? "" : ", ") + (data.cameras[i].name.empty() ? std::to_string(i) : data.cameras[i].name);
      return badViewpoint("the scene has no camera '" + viewpoint.camera + "'",
                          names.empty() ? "it has none at all; use --orbit" : "it has: " + names);
    }
    const scene::Camera& camera = data.cameras[*index];
    // Scale in a camera's matrix means nothing.
    const std::vector<scene::PlayedClip> clips = playedClips(data, look.data().at(time));
    view.node = cameraNode(data, *index);
    glm::mat4 world =
        view.node < 0 ? glm::mat4(1.0f) : scene::poseAt(data, clips, time).world[size_t(view.node)];
    for (int axis = 0; axis < 3; ++axis)
      if (const float length = glm::length(glm::vec3(world[axis])); length > 1e-12f) world[axis] /= length;
    view.worldToEye =
        glm::rotate(glm::mat4(1.0f), glm::radians(viewpoint.roll), glm::vec3(0, 0, 1)) * glm::inverse(world);
    const float radius = std::max(data.bounds.radius(), 1e-6f);
    if (camera.perspective) {
      if (!viewpoint.verticalFov) fov = std::clamp(camera.verticalFov, 0.001f, 3.1f);
      view.eyeToClip = perspectiveProjection(fov, aspect, std::max(camera.near, 1e-6f * radius));
    } else {
      const float far = camera.far > camera.near ? camera.far : camera.near + 100 * radius;
      view.eyeToClip = orthographicProjection(camera.halfHeight, aspect, camera.near, far);
    }
  }

  if (stereo == Stereo::mono) return std::vector<View>{view};
  std::vector<View> eyes(2, view);
  for (int i = 0; i < 2; ++i)
    eyes[size_t(i)].worldToEye =
        glm::translate(glm::mat4(1.0f), glm::vec3((i == 0 ? 0.5f : -0.5f) * ipd, 0, 0)) * view.worldToEye;
  return eyes;
}

}  // namespace scumble
