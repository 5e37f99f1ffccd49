// MetaTexture in double precision, written from paper 000 and FORMULAS, not from the shader.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "base/pixels.h"

namespace scumble::test {

// A repeating picture of bytes, between texels as GPUs have it.
struct RepeatingTexture {
  Pixels pixels;
  glm::dvec4 sample(const glm::dvec2& uv) const;
};

// Of a picture's bytes / 255, and the deviation from it.
glm::dvec4 meanOf(const Pixels& pixels);
glm::dvec4 deviationOf(const Pixels& pixels);

struct MetaTextureReference {
  RepeatingTexture texture;
  glm::dvec4 mean{0.5};
  double size = 256, height = 1;  // of the example on the screen: pixels, and as a part of that
  double base = 2, levelRotation = 0, blend = 1, skip = 0;  // ratio, radians a level
  int skewLevels = 4;
  enum { off, approximate, exact } skew = off;
  bool contour = false, contrast = true, nested = false;
  glm::dvec2 shift{0.0};

  struct Copy {
    double share;
    glm::dvec2 at;            // coordinates in the texture
    glm::dvec2 gradU, gradV;  // of those coordinates' axes before levelRotation, per pixel
  };
  struct Result {
    glm::dvec4 value;
    glm::dvec2 exponent;  // between both levels of skew
    double q, variance;
    // How many times finer than its size it comes out, in the direction in which that is the most.
    double fineness;
    std::vector<Copy> copies;
  };
  // gradU, gradV: of u and v on the screen, per pixel. `wraps`: whether u and v close on themselves after one
  // unit.
  Result at(const glm::dvec2& uv, const glm::dvec2& gradU, const glm::dvec2& gradV, double alpha = 1,
            const glm::bvec2& wraps = glm::bvec2(false)) const;
};

}  // namespace scumble::test
