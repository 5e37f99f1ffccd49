// Where heads are in the scene: poses and angles as OpenXR has them, as views. Arithmetic alone.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "scumble/view.h"
#include "xr/openxr.h"

namespace scumble::xr {

struct Pose {
  glm::quat turn{1, 0, 0, 0};
  glm::vec3 place{0};  // metres
};
Pose poseOf(const XrPosef& pose);
XrPosef xrOf(const Pose& pose);
glm::mat4 matrixOf(const Pose& pose);  // from its own space to that which it is in

// Half way: a head, of its eyes.
Pose between(const Pose& a, const Pose& b);

// The room that somebody wears a headset in, in the scene: its origin and its z axis (backwards), level.
struct Stand {
  glm::vec3 place{0};      // metres, of the room's origin
  float heading = 0;       // radians about y
  float scale = 1;         // so many metres of the scene are one of the room
  glm::dvec3 origin{0.0};  // of the world, from which places in the scene count (View::origin)
};

glm::quat aboutVertical(float angle);  // radians, from z to x

// Where a camera is, level: what it looks at lies straight ahead. A room whose origin is a head's place
// stands with it at the camera; one whose origin lies on the floor, `eyeHeight` metres of the room below it.
Stand standAt(const View& camera, float scale, float eyeHeight);

// A place and a turn of the room in the scene.
Pose inScene(const Stand& stand, const Pose& inRoom);
Pose inRoom(const Stand& stand, const Pose& inScene);
// Where a room is, as seen from another one; in metres of that.
Pose seenFrom(const Stand& from, const Stand& room);

// What runtimes tell need not make sense while they start, or are lost: whether it is a place and a turn, and
// whether there is a view for an eye.
bool isPlace(const Pose& pose);
bool canBeSeenFrom(const Pose& eye, const XrFovf& angles);

// An eye of the room as a view of the scene.
View viewOf(const Stand& stand, const Pose& eye, const XrFovf& angles, float nearPlane);

// Off-centre, depth reversed, the far plane infinite (scumble/view.h).
glm::mat4 projectionOf(const XrFovf& angles, float nearPlane);

}  // namespace scumble::xr
