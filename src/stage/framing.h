// Where a scene is seen from when nobody says.
#pragma once

#include <span>

#include "scene/scene_data.h"

namespace scumble::stage {

// The first node that carries this camera; -1: none does.
int cameraNode(const scene::SceneData& scene, size_t camera);

// Three-quarter view from the front: direction from the scene's centre.
glm::vec3 frontDirection(const scene::SceneData& scene);

// Direction from the scene's centre to the default viewpoint: its first camera at rest, else the same.
glm::vec3 defaultEyeDirection(const scene::SceneData& scene);

// Direction for an azimuth and elevation in degrees (see Viewpoint).
glm::vec3 orbitDirection(float azimuth, float elevation);

// Where one stands to see points: looking at `target` from so far away, they take two thirds of the frame's
// height or width. Angles in radians.
struct Framing {
  glm::vec3 target{0.0f};
  float distance = 0;
};
// In the middle of the frame.
Framing framingOf(std::span<const glm::vec3> points, const glm::vec3& direction, float verticalFov,
                  float aspect);

// Around a target that is given: none of the points reaches farther from the frame's middle.
float framingDistance(std::span<const glm::vec3> points, const glm::vec3& target, const glm::vec3& direction,
                      float verticalFov, float aspect);

// The same from every azimuth, so that it stays while one goes around. The elevation is in degrees.
float framingDistanceAllAround(std::span<const glm::vec3> points, const glm::vec3& target, float elevation,
                               float verticalFov, float aspect);

}  // namespace scumble::stage
