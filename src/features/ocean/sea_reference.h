// The sea in double precision, wave by wave, from docs/ocean.md and Tessendorf 2004: no transform, and slopes
// by differences instead of derivatives. Of the code it takes the random numbers alone.
#pragma once

#include <complex>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "tests/support/test_scene.h"

namespace scumble::test {

// As the knobs of `ocean` say it; deep water.
struct SeaState {
  int grid = 16;                        // points along a tile
  double tile = 24;                     // metres
  double wind = 12, windDirection = 0;  // m/s; degrees, where it blows to: 0 is +x, 90 is +z
  double fetch = 20, smallest = 4;      // km, metres
  double choppiness = 1, height = 1, loop = 20;
  uint32_t seed = 1;
};

class SeaReference {
 public:
  SeaReference(const SeaState& state, double seconds);

  // Where the water at rest at (x, z) metres of the tile has gone to.
  glm::dvec3 at(double x, double z) const;
  // The cross product of both tangents of the displaced surface, by central differences: not of length 1; its
  // y is the Jacobian of the horizontal movement.
  glm::dvec3 across(double x, double z) const;
  // Metres: standard deviation of the height over all seeds.
  double deviation() const { return deviation_; }

  // The mesh around the middle, `half` cells to each side, as it lies in the world once the scene has
  // travelled so far over the water. A cell is split from (i, j) to (i + 1, j + 1).
  struct Corner {
    glm::dvec3 at, normal;
    double height, jacobian;
  };
  struct Mesh {
    std::vector<Corner> corners;  // of triangles, three each
    std::vector<WorldTriangle> triangles;
  };
  Mesh mesh(int half, const glm::dvec2& travelled) const;

 private:
  struct Wave {
    glm::dvec2 k;               // radians a metre
    std::complex<double> size;  // metres, now
  };
  SeaState state_;
  std::vector<Wave> waves_;
  double deviation_ = 0;
};

}  // namespace scumble::test
