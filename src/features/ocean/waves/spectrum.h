// Sea states: how much of the surface's variance each wave carries, how fast it goes, and its amplitude.
//
// A wave's number (x, z) counts its crests along the edges of a tile; its wave vector is 2 pi / tile times
// that, in radians a metre. It travels along its wave vector.
#pragma once

#include <complex>
#include <cstdint>

namespace scumble::ocean {

struct Spectrum {
  enum Kind : uint32_t {
    phillips,  // of a fully developed sea (Tessendorf 2004, eq. 23, in physical units)
    jonswap,   // of a sea that has had `fetch` to grow (Hasselmann et al. 1973)
  };

  int grid = 80;     // points an edge of a tile, 1 to 256; 1 and 2 are too few for any wave
  double tile = 60;  // metres an edge, 1 to 10000; the surface repeats after it
  Kind kind = jonswap;
  double wind = 10;          // m/s, 10 m above the water, 0 (calm) to 60
  double windDirection = 0;  // degrees, where the wind blows to: 0 is +x, 90 is +z
  double fetch = 100;        // km of open water up-wind, 1 to 10000; of jonswap only
  double choppiness = 1;     // 0 to 2: horizontal displacement; at 1 water goes in circles
  double depth = 1000;       // metres, 0.1 to 10000
  double loop = 20;          // seconds, 1 to 600, after which the movement repeats
  double height = 1;         // factor of all heights, 0 or more
  double smallest = 2;       // metres, 0 or more: a wave of this length keeps 1 / e of its variance
  uint32_t seed = 1;

  bool operator==(const Spectrum&) const = default;
};

// Largest component of wave numbers that the grid holds. An even grid's Nyquist waves are left out: sampled
// as they are, a travelling wave cannot be told from a standing one, and their slopes vanish.
int lastWave(const Spectrum& spectrum);

// Radians a second of a wave of `k` radians a metre (Tessendorf 2004, eq. 14), as water has it.
double waterFrequency(const Spectrum& spectrum, double k);

// Whole cycles that the wave makes in `loop`: rounded down (eq. 17), and at least 1. A wave with none would
// be a frozen hill; without it the height's variance would not be the spectrum's.
uint32_t cycles(const Spectrum& spectrum, double k);

// Density of the height's variance over wave vectors, m^2 / (rad/m)^2, of waves that travel along (kx, kz)
// radians a metre. Its integral over the plane is the variance of the height.
double density(const Spectrum& spectrum, double kx, double kz);

// m^2: the density's integral over the square of wave vectors that are nearest to this wave's. A sample in
// its middle would miss the sharp peaks of growing seas, which are narrower than such a square. 0 for (0, 0).
double waveVariance(const Spectrum& spectrum, int x, int z);

// Of mean square 1, complex and normal (Box and Muller 1958): a hash of these three numbers, from -32768 to
// 32767. So a sea of other `grid` has the same long waves, and every machine has the same sea.
std::complex<double> waveGaussian(uint32_t seed, int x, int z);

// Metres: h0 of Tessendorf's eq. 25. The wave's height is h0 e^i(k.x - w t) plus its conjugate, and its mean
// square over seeds is `variance`, that wave's waveVariance.
std::complex<double> amplitude(const Spectrum& spectrum, double variance, int x, int z);

}  // namespace scumble::ocean
