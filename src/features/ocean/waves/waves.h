// Waves of deep and shallow water as a sum of travelling sines (Tessendorf, "Simulating ocean water", 2004),
// over a tile that repeats without a seam, in a movement that repeats after `loop` seconds.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <vector>

#include "features/ocean/waves/spectrum.h"

struct kiss_fft_state;

namespace scumble::ocean {

// The surface at one moment. Point (i, j) is at rest at (i, j) * tile / grid metres along (x, z), and it is
// element j * grid + i; the point after the last is the next tile's first.
struct WaveField {
  int grid = 0;
  double tile = 0;  // metres

  // x, y (up), z: where the point has moved to from its place at rest, in metres. w: the Jacobian's
  // determinant of the horizontal movement (Tessendorf's eq. 32): 1 in calm, 0 where the surface is pressed
  // together to nothing, below 0 where it is folded.
  std::vector<glm::vec4> displacement;

  // Of the height: d y / d x and d y / d z over places at rest, as if nothing moved sideways (eq. 20).
  std::vector<glm::vec2> slopes;

  // Of length 1, of the smooth surface after all movement. Where it is folded it points downwards.
  std::vector<glm::vec3> normals;

  // Metres: the least and the greatest horizontal displacement, x and z each by themselves.
  glm::vec2 leastShift{0}, greatestShift{0};
};

class Waves {
 public:
  // Takes milliseconds. Values of the spectrum must be within their ranges.
  explicit Waves(const Spectrum& spectrum);

  // The surface at this time, which may be any; `out` is written anew. A pure function of spectrum and time;
  // threads may call it side by side.
  void at(double seconds, WaveField& out) const;

  // m^2: variance of the height that the spectrum has in the waves which tile and grid hold, their sum. What
  // a sea has over place and time differs by its seed, and is this on the average of seeds. Four times its
  // root is the significant wave height.
  double variance() const { return variance_; }

  const Spectrum& spectrum() const { return spectrum_; }

 private:
  // A wave and the one against it: the two together make one complex amplitude and its conjugate.
  struct Pair {
    uint32_t at, opposite;  // elements of the transform, x * grid + z
    uint32_t cycles;        // in a loop
    glm::vec2 along;        // h0 of the wave along k
    glm::vec2 against;      // conjugate of h0 of the wave along -k
    glm::vec2 k;            // radians a metre
    float inverseLength;    // metres a radian
  };

  template <class Factors, class Take>
  void transform(const std::vector<glm::vec2>& heights, Factors&& factors, Take&& take) const;

  Spectrum spectrum_;
  double variance_ = 0;
  std::vector<Pair> pairs_;
  uint32_t mostCycles_ = 0;
  float typicalLength_ = 1;                     // metres a radian
  std::shared_ptr<const kiss_fft_state> plan_;  // complex, inverse, `grid` points
};

}  // namespace scumble::ocean
