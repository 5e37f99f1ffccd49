// Where a scene is seen from when nobody says.
#pragma once

#include "scene/scene_data.h"

namespace scumble::stage {

// The first node that carries this camera; -1: none does.
int cameraNode(const scene::SceneData& scene, size_t camera);

// Direction from the scene's centre to the default viewpoint: its first camera at rest, else three-quarter
// view from the front.
glm::vec3 defaultEyeDirection(const scene::SceneData& scene);

// Direction for an azimuth and elevation in degrees (see Viewpoint).
glm::vec3 orbitDirection(float azimuth, float elevation);

// Distance from the centre of `bounds` at which all of it is seen, with air around it. Angles in radians.
float framingDistance(const scene::Bounds& bounds, const glm::vec3& direction, float verticalFov,
                      float aspect);

// The least distance at which all of it is seen from every azimuth, so that it stays while one goes around.
// The elevation is in degrees.
float framingDistanceAllAround(const scene::Bounds& bounds, float elevation, float verticalFov, float aspect);

}  // namespace scumble::stage
