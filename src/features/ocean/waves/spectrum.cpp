#include "features/ocean/waves/spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scumble::ocean {

namespace {

using std::numbers::pi;

constexpr double kGravity = 9.81;  // m/s^2
constexpr double kPhillips = 0.0081;
constexpr double kPeak = 3.3;          // JONSWAP's gamma
constexpr double kAgainst = 0.01;      // of the variance that waves against the wind keep
constexpr double kFullGrowth = 0.855;  // wind speed by phase speed of the peak: Pierson and Moskowitz (1964)

// The density with what is the same for all waves worked out.
//
// Over all directions it is level / (2 k^3) * shape(w). Written so, the same lines hold in all depths: this
// is the TMA spectrum (Bouws et al. 1985), whose factor tanh^2(kd) / (1 + 2kd / sinh 2kd) cancels against
// dw/dk and w^-5. In deep water Phillips' shape is Tessendorf's exp(-1 / (k L)^2), L = wind^2 / g.
class Density {
 public:
  explicit Density(const Spectrum& spectrum)
      : spectrum_(spectrum),
        toX_(std::cos(spectrum.windDirection * (pi / 180))),
        toZ_(std::sin(spectrum.windDirection * (pi / 180))) {
    const double speed = kGravity / spectrum.wind;
    if (spectrum.kind == Spectrum::phillips) {
      level_ = kPhillips;
      peak_ = speed;
      return;
    }
    // Fetch in units of wind^2 / g; beyond full growth a sea gains nothing.
    const double x = std::min(1000 * spectrum.fetch * kGravity / (spectrum.wind * spectrum.wind),
                              std::pow(22 / kFullGrowth, 3));
    level_ = 0.076 * std::pow(x, -0.22);
    peak_ = 22 * speed / std::cbrt(x);
  }

  double operator()(double kx, double kz) const {
    const double k = std::hypot(kx, kz);
    if (!(k > 0 && spectrum_.wind > 0)) return 0;
    const double along = (kx * toX_ + kz * toZ_) / k;
    const double spreading = 2 / (pi * (1 + kAgainst)) * along * along * (along < 0 ? kAgainst : 1);
    const double small = k * spectrum_.smallest / (2 * pi);
    const double exponent = shapeExponent(waterFrequency(spectrum_, k)) - small * small;
    return level_ / (2 * k * k * k * k) * spreading * std::exp(exponent) * spectrum_.height *
           spectrum_.height;
  }

 private:
  // The logarithm of the shape.
  double shapeExponent(double w) const {
    const double slow = (peak_ / w) * (peak_ / w);
    if (spectrum_.kind == Spectrum::phillips) return -slow * slow;
    const double away = (w / peak_ - 1) / (w < peak_ ? 0.07 : 0.09);
    return -1.25 * slow * slow + std::log(kPeak) * std::exp(-0.5 * away * away);
  }

  const Spectrum& spectrum_;
  double toX_, toZ_;  // where the wind blows to
  double level_, peak_;
};

// A bijection, so that no two waves of a seed ever share their numbers (SplitMix64: Steele, Lea, Flood 2014).
uint64_t mixed(uint64_t value) {
  value += 0x9e3779b97f4a7c15u;
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9u;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebu;
  return value ^ (value >> 31);
}

}  // namespace

int lastWave(const Spectrum& spectrum) {
  return (spectrum.grid - 1) / 2;
}

double waterFrequency(const Spectrum& spectrum, double k) {
  return std::sqrt(kGravity * k * std::tanh(k * spectrum.depth));
}

uint32_t cycles(const Spectrum& spectrum, double k) {
  return uint32_t(std::max(1.0, std::floor(waterFrequency(spectrum, k) * spectrum.loop / (2 * pi))));
}

double density(const Spectrum& spectrum, double kx, double kz) {
  return Density(spectrum)(kx, kz);
}

double waveVariance(const Spectrum& spectrum, int x, int z) {
  if (x == 0 && z == 0) return 0;
  // Steps of at most 1/24 of the wave vector's length, which is fine beside a peak's width of a third.
  const double step = 2 * pi / spectrum.tile;
  const int parts = std::clamp(int(std::ceil(24 / std::hypot(x, z))), 2, 24);
  const Density at(spectrum);
  double sum = 0;
  for (int j = 0; j < parts; ++j)
    for (int i = 0; i < parts; ++i)
      sum += at(step * (x - 0.5 + (i + 0.5) / parts), step * (z - 0.5 + (j + 0.5) / parts));
  return sum * (step / parts) * (step / parts);
}

std::complex<double> waveGaussian(uint32_t seed, int x, int z) {
  const uint64_t bits = mixed(uint64_t(seed) << 32 | uint64_t(uint16_t(x)) << 16 | uint16_t(z));
  const double share = (double(bits >> 32) + 1) / 4294967296.0;  // above 0, for the logarithm
  const double turns = double(bits & 0xffffffffu) / 4294967296.0;
  return std::polar(std::sqrt(-std::log(share)), 2 * pi * turns);
}

std::complex<double> amplitude(const Spectrum& spectrum, double variance, int x, int z) {
  return std::sqrt(0.5 * variance) * waveGaussian(spectrum.seed, x, z);
}

}  // namespace scumble::ocean
