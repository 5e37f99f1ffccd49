// Conversion between places, relative to the view's origin (View::origin, metres), and pixels of the window
// (y downwards).
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "scumble/view.h"

namespace scumble::viewer {

class Lens {
 public:
  Lens(const View& view, const glm::vec2& window);

  // Matrix from world coordinates to those of the view's origin.
  glm::dmat4 fromWorld() const;
  const glm::dvec3& origin() const { return origin_; }

  // Nothing where a place is behind the viewer.
  std::optional<glm::vec2> pixelOf(const glm::vec3& place) const;
  struct Ray {
    glm::vec3 from, way;  // of unit length
  };
  Ray rayAt(const glm::vec2& pixel) const;
  // Metres that a pixel is wide at a place.
  float pixelSize(const glm::vec3& place) const;
  const glm::vec3& right() const { return eyeToWorld_[0]; }

  // Where what lies at `place` goes when it is dragged to a pixel: in the plane that faces the viewer,
  glm::vec3 draggedFreely(const glm::vec3& place, const glm::vec2& pixel) const;
  // at its height (nothing where the pixel sees the sky, or the plane from its edge),
  std::optional<glm::vec3> draggedLevel(const glm::vec3& place, const glm::vec2& pixel) const;
  // and along an axis of unit length (nothing where one looks along it).
  std::optional<glm::vec3> draggedAlong(const glm::vec3& place, const glm::vec3& axis,
                                        const glm::vec2& pixel) const;

  // Directions as places on a disc, x to the right and y downwards: what comes from the viewer lies in its
  // middle, what comes from a side at a distance of 1, and what comes from behind at 2 (and beyond, where a
  // hand goes too far).
  glm::vec2 discOf(const glm::vec3& direction) const;
  glm::vec3 directionAt(const glm::vec2& disc) const;

 private:
  glm::mat4 worldToClip_;
  glm::dmat4 clipToWorld_;  // of near planes that are a thousandth of the way to what is seen
  glm::mat3 eyeToWorld_;
  glm::vec2 window_;
  glm::dvec3 origin_;
};

}  // namespace scumble::viewer
