#include "navigation.h"

#include <algorithm>
#include <cmath>

namespace scumble::viewer {

namespace {

constexpr float kTurn = 220;                    // degrees that a drag over the window's height turns
constexpr float kSteepest = 87.4f;              // degrees; steeper, makeViews takes another direction for up
constexpr float kZoomStep = 6 / 7.f;            // of the way that is left
constexpr float kNarrowest = 1, kWidest = 150;  // degrees
constexpr float kLevel = 1e-3f;                 // degrees; what is less is rounding

float azimuthOf(const glm::vec3& away) {
  return glm::degrees(std::atan2(away.x, away.z));
}
float elevationOf(const glm::vec3& away) {
  return glm::degrees(std::asin(std::clamp(away.y / std::max(glm::length(away), 1e-30f), -1.0f, 1.0f)));
}
glm::vec3 awayBy(float azimuth, float elevation) {
  const float a = glm::radians(azimuth), e = glm::radians(std::clamp(elevation, -kSteepest, kSteepest));
  return {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
}

}  // namespace

void Navigation::takeUp(const View& view, const glm::dvec3& centre, float radius) {
  const glm::mat4 toWorld = glm::inverse(view.worldToEye);
  const glm::vec3 up(toWorld[1]), forward = -glm::normalize(glm::vec3(toWorld[2]));
  radius_ = std::max(radius, 1e-6f);
  origin_ = view.origin;
  eye_ = glm::vec3(toWorld[3]);
  const float ahead = glm::dot(glm::vec3(centre - origin_) - eye_, forward);
  const float distance = ahead > 1e-3f * radius_ ? ahead : radius_;
  target_ = eye_ + forward * distance;

  const glm::mat4& p = view.eyeToClip;
  const float halfHeight = 1 / std::abs(p[1][1]);  // at distance 1, or at all of them
  field_ = glm::degrees(2 * std::atan(p[3][3] == 1 ? halfHeight / distance : halfHeight));
  field_ = std::clamp(field_, kNarrowest, kWidest);
  roll_ = 0;
  const Axes level = axes();
  roll_ = glm::degrees(std::atan2(glm::dot(up, level.right), glm::dot(up, level.up)));
  if (std::abs(roll_) < kLevel) roll_ = 0;
}

Navigation::Axes Navigation::axes() const {
  Axes a;
  a.forward = glm::normalize(target_ - eye_);
  glm::vec3 right = glm::cross(a.forward, glm::vec3(0, 1, 0));
  if (glm::dot(right, right) < 1e-12f) right = {1, 0, 0};
  right = glm::normalize(right);
  const glm::vec3 up = glm::cross(right, a.forward);
  // The camera turns clockwise: its top leans to the right.
  const float r = glm::radians(roll_);
  a.right = std::cos(r) * right - std::sin(r) * up;
  a.up = std::cos(r) * up + std::sin(r) * right;
  return a;
}

// A drag as the hand of somebody sees it whose head is not rolled.
glm::vec2 Navigation::upright(const glm::vec2& drag) const {
  const float r = glm::radians(roll_), c = std::cos(r), s = std::sin(r);
  return {c * drag.x - s * drag.y, s * drag.x + c * drag.y};
}

void Navigation::place(float azimuth, float elevation, float distance) {
  eye_ = target_ + distance * awayBy(azimuth, elevation);
}

void Navigation::orbit(const glm::vec2& drag) {
  const glm::vec2 d = upright(drag);
  const glm::vec3 away = eye_ - target_;
  place(azimuthOf(away) - kTurn * d.x, elevationOf(away) + kTurn * d.y, glm::length(away));
}

void Navigation::lookFrom(float azimuth, float elevation) {
  roll_ = 0;
  place(azimuth, elevation, distance());
}

void Navigation::pan(const glm::vec2& drag) {
  const Axes a = axes();
  const float height = 2 * distance() * std::tan(glm::radians(field_) / 2);
  const glm::vec3 step = height * (drag.y * a.up - drag.x * a.right);
  eye_ += step, target_ += step;
}

void Navigation::zoom(float steps) {
  const float least = 1e-4f * radius_, most = 1e4f * radius_;
  const float to = std::clamp(distance() * std::pow(kZoomStep, steps), least, most);
  eye_ = target_ + to * glm::normalize(eye_ - target_);
}

void Navigation::lookAround(const glm::vec2& drag) {
  const glm::vec2 d = field_ * upright(drag);
  const glm::vec3 ahead = target_ - eye_;
  target_ = eye_ + glm::length(ahead) * awayBy(azimuthOf(ahead) - d.x, elevationOf(ahead) - d.y);
}

void Navigation::fly(const glm::vec3& way) {
  const Axes a = axes();
  const glm::vec3 step = distance() * (way.x * a.right + way.y * a.up + way.z * a.forward);
  eye_ += step, target_ += step;
}

void Navigation::roll(float degrees) {
  roll_ = std::remainder(roll_ + degrees, 360.0f);
}

void Navigation::widen(float factor) {
  field_ = std::clamp(field_ * factor, kNarrowest, kWidest);
}

Viewpoint Navigation::viewpoint() const {
  Viewpoint viewpoint;
  viewpoint.eye = origin_ + glm::dvec3(eye_), viewpoint.target = origin_ + glm::dvec3(target_);
  viewpoint.roll = roll_, viewpoint.verticalFov = field_;
  return viewpoint;
}

}  // namespace scumble::viewer
