// All views of a frame at once, for what is decided once for all of them: which blended surfaces can be seen,
// and how far they are. (Of the others each group of views finds its own, on the device.)
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace scumble::stage {

struct Viewers {
  struct Window {
    glm::mat4 worldToClip;
    glm::vec2 margin;  // how far what is outside may reach in, in normalised device coordinates
  };
  std::vector<Window> windows;
  glm::vec3 middle{0.0f};     // of all eyes, world
  glm::vec3 ahead{0, 0, -1};  // unit, world
  bool isParallel = false;    // a parallel projection

  // Grows with what lies farther away.
  float distanceTo(const glm::vec3& place) const {
    return isParallel ? glm::dot(place - middle, ahead) : glm::length(place - middle);
  }
};

}  // namespace scumble::stage
