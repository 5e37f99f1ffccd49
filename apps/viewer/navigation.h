// Where the window's camera stands, and how hands move it: arithmetic alone. Distances in metres, angles in
// degrees; drags in heights of the window, x to the right and y downwards.
#pragma once

#include <glm/glm.hpp>

#include "scumble/view.h"

namespace scumble::viewer {

class Navigation {
 public:
  // From where a view sees; what it looks at lies in its middle, as far away as `centre` is. `radius`: of the
  // scene. Parallel projections become a perspective of what they show there.
  void takeUp(const View& view, const glm::dvec3& centre, float radius);

  void orbit(const glm::vec2& drag);       // around what is looked at; the vertical stays the vertical
  void pan(const glm::vec2& drag);         // what is looked at goes with the hand
  void zoom(float steps);                  // towards it; each takes away a seventh of the way
  void lookAround(const glm::vec2& drag);  // from where it stands
  void fly(const glm::vec3& way);          // to the right, up and forwards, in distances to what is looked at
  void roll(float degrees);                // clockwise
  void widen(float factor);                // the field of view
  void lookFrom(float azimuth, float elevation);  // as Viewpoint has them, from where it is as far away

  // What makes this camera of it: eye, target, roll and field.
  Viewpoint viewpoint() const;
  float distance() const { return glm::distance(eye_, target_); }

 private:
  struct Axes {
    glm::vec3 right, up, forward;
  };
  Axes axes() const;  // with the roll
  void place(float azimuth, float elevation, float distance);
  glm::vec2 upright(const glm::vec2& drag) const;

  glm::dvec3 origin_{0.0};  // of the world, from which these count
  glm::vec3 eye_{0, 0, 1}, target_{0};
  float roll_ = 0, field_ = 34;
  float radius_ = 1;
};

}  // namespace scumble::viewer
