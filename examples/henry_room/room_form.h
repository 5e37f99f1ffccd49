// The measures of the burrow: two round shells, the room and the parlour behind it, and what opens them.
// Bearings are degrees around +Y from +X towards +Z, as seen from a shell's centre; metres.
#pragma once

#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

namespace henry {

constexpr int kColumns = 100;  // of a shell's mesh, so openings stand at bearings of whole columns
constexpr float kColumnDegrees = 360.0f / float(kColumns);
constexpr float kThickness = 0.30f;
constexpr float kSunBearing = 219.0f, kSunElevation = 25.0f;

inline glm::vec3 towards(float bearing) {
  const float a = glm::radians(bearing);
  return {std::cos(a), 0.0f, std::sin(a)};
}

// The direction to the sun.
inline glm::vec3 towardsSun() {
  const float elevation = glm::radians(kSunElevation);
  return std::cos(elevation) * towards(kSunBearing) + glm::vec3(0, std::sin(elevation), 0);
}

// A hole straight through a shell. `inside` is told metres along the wall and above the floor.
struct Opening {
  int column, halfColumns;    // the middle, and how many columns of the mesh it takes to both sides
  float bottom, top, middle;  // metres; what it takes of the mesh's height, and a point that sees all of it
  std::function<bool(float along, float up)> inside;

  float bearing() const { return float(column) * kColumnDegrees; }
};

// An upright oval window, and a passage with a round head.
struct Oval {
  float height, halfWidth, halfHeight;  // metres; of its middle above the floor
};
inline Opening ovalOpening(int column, int halfColumns, const Oval& oval, float margin) {
  const float reach = oval.halfHeight + margin;
  return {column, halfColumns, oval.height - reach, oval.height + reach, oval.height, [=](float x, float y) {
            const glm::vec2 p = {x / oval.halfWidth, (y - oval.height) / oval.halfHeight};
            return glm::dot(p, p) < 1.0f;
          }};
}
inline Opening archedOpening(int column, int halfColumns, float halfWidth, float height, float top) {
  return {column, halfColumns, -0.05f, top, 0.8f, [=](float x, float y) {
            const float above = std::max(y - (height - halfWidth), 0.0f);
            return x * x + above * above < halfWidth * halfWidth;
          }};
}

// A superellipse turned around +Y: nearly upright walls that bend into a low vault.
struct Shell {
  glm::vec3 center;
  float radius, apex;
  std::vector<Opening> openings;

  float radiusAt(float height, float outwards = 0.0f) const {
    constexpr float kWaist = 0.9f, kPower = 3.2f;
    const float t = std::abs(height - kWaist) / (apex - kWaist + outwards);
    return (radius + outwards) * std::pow(std::max(1.0f - std::pow(t, kPower), 0.0f), 1.0f / kPower);
  }
  // On the wall, or `inwards` before it.
  glm::vec3 at(float bearing, float height, float inwards = 0.0f) const {
    return center + (radiusAt(height) - inwards) * towards(bearing) + glm::vec3(0, height, 0);
  }
};

// Stands on a wall: +X to the right as seen from the room, +Y up, +Z into the room.
inline glm::quat onWall(float bearing) {
  return glm::angleAxis(glm::radians(-90.0f - bearing), glm::vec3(0, 1, 0));
}

constexpr Oval kWindow = {1.70f, 0.56f, 0.68f}, kParlourWindow = {1.45f, 0.42f, 0.52f};
constexpr int kWindowColumns[] = {52, 59, 65};
constexpr int kArchColumn = 77, kDoorColumn = 89, kParlourWindowColumn = 64;
constexpr float kArchHalfWidth = 0.76f, kArchHeight = 1.90f;
constexpr float kDoorHalfWidth = 0.46f, kDoorHeight = 1.66f;
constexpr float kDado = 0.78f;  // the wainscot's height

inline const Shell& room() {
  static const Shell shell = [] {
    Shell s{{0, 0, 0}, 3.3f, 3.05f, {}};
    for (int column : kWindowColumns) s.openings.push_back(ovalOpening(column, 3, kWindow, 0.05f));
    s.openings.push_back(archedOpening(kArchColumn, 4, kArchHalfWidth, kArchHeight, 2.12f));
    s.openings.push_back(archedOpening(kDoorColumn, 3, kDoorHalfWidth, kDoorHeight, 2.12f));
    return s;
  }();
  return shell;
}

// Its wall touches the room's outside, so the two openings between them make one passage.
inline const Shell& parlour() {
  static const Shell shell = [] {
    const float bearing = float(kArchColumn) * kColumnDegrees;
    Shell s{(room().radius + kThickness + 2.1f) * towards(bearing), 2.1f, 2.45f, {}};
    s.openings.push_back(ovalOpening(kParlourWindowColumn, 5, kParlourWindow, 0.07f));
    s.openings.push_back(
        archedOpening(kArchColumn - kColumns / 2, 7, kArchHalfWidth + 0.02f, kArchHeight + 0.02f, 2.05f));
    return s;
  }();
  return shell;
}

}  // namespace henry
