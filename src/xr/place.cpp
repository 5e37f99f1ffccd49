#include "xr/place.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace scumble::xr {

glm::quat aboutVertical(float angle) {
  return {std::cos(0.5f * angle), 0, std::sin(0.5f * angle), 0};
}

Pose poseOf(const XrPosef& pose) {
  const XrQuaternionf& q = pose.orientation;
  const glm::quat turn(q.w, q.x, q.y, q.z);
  // None at all leaves no numbers.
  return {turn * (1 / glm::length(turn)), {pose.position.x, pose.position.y, pose.position.z}};
}

XrPosef xrOf(const Pose& pose) {
  return {{pose.turn.x, pose.turn.y, pose.turn.z, pose.turn.w}, {pose.place.x, pose.place.y, pose.place.z}};
}

glm::mat4 matrixOf(const Pose& pose) {
  glm::mat4 matrix = glm::mat4_cast(pose.turn);
  matrix[3] = glm::vec4(pose.place, 1);
  return matrix;
}

Pose between(const Pose& a, const Pose& b) {
  return {glm::normalize(glm::slerp(a.turn, b.turn, 0.5f)), 0.5f * (a.place + b.place)};
}

Stand standAt(const View& camera, float scale, float eyeHeight) {
  const glm::vec3 place(glm::inverse(camera.worldToEye)[3]);
  return {place - glm::vec3(0, eyeHeight * scale, 0), headingOf(camera), scale, camera.origin};
}

Pose inScene(const Stand& stand, const Pose& inRoom) {
  const glm::quat heading = aboutVertical(stand.heading);
  return {heading * inRoom.turn, stand.place + stand.scale * (heading * inRoom.place)};
}

Pose inRoom(const Stand& stand, const Pose& inScene) {
  const glm::quat back = aboutVertical(-stand.heading);
  return {back * inScene.turn, back * (inScene.place - stand.place) / stand.scale};
}

Pose seenFrom(const Stand& from, const Stand& room) {
  return inRoom(from, {aboutVertical(room.heading), room.place});
}

bool isPlace(const Pose& pose) {
  const glm::quat& turn = pose.turn;
  const float numbers[] = {turn.x, turn.y, turn.z, turn.w, pose.place.x, pose.place.y, pose.place.z};
  return std::all_of(std::begin(numbers), std::end(numbers),
                     [](float number) { return std::abs(number) < 1e6f; });
}

bool canBeSeenFrom(const Pose& eye, const XrFovf& angles) {
  if (!isPlace(eye)) return false;
  const auto isBetween = [](float low, float high) {
    constexpr float kMost = 1.55f;  // nearly a right angle
    return low >= -kMost && high <= kMost && high - low > 1e-3f;
  };
  return isBetween(angles.angleLeft, angles.angleRight) && isBetween(angles.angleDown, angles.angleUp);
}

View viewOf(const Stand& stand, const Pose& eye, const XrFovf& angles, float nearPlane) {
  View view;
  view.worldToEye = glm::inverse(matrixOf(inScene(stand, eye)));
  view.eyeToClip = projectionOf(angles, nearPlane);
  view.origin = stand.origin;
  return view;
}

glm::mat4 projectionOf(const XrFovf& angles, float nearPlane) {
  const float left = std::tan(angles.angleLeft), right = std::tan(angles.angleRight);
  const float up = std::tan(angles.angleUp), down = std::tan(angles.angleDown);
  glm::mat4 p(0.0f);
  p[0][0] = 2 / (right - left);
  p[2][0] = (right + left) / (right - left);
  p[1][1] = -2 / (up - down);  // y down
  p[2][1] = -(up + down) / (up - down);
  p[2][3] = -1;
  p[3][2] = nearPlane;
  return p;
}

}  // namespace scumble::xr
