#include "features/ocean/waves/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace scumble::ocean {
namespace {

using std::numbers::pi;

// The frequency spectra as their papers have them, m^2 s, for deep water.
double jonswapOf(double w, double wind, double fetchMetres) {
  const double g = 9.81, peak = 22 * std::cbrt(g * g / (wind * fetchMetres));
  const double level = 0.076 * std::pow(wind * wind / (fetchMetres * g), 0.22);
  const double width = w <= peak ? 0.07 : 0.09;
  const double bump = std::exp(-std::pow(w - peak, 2) / (2 * width * width * peak * peak));
  return level * g * g * std::pow(w, -5) * std::exp(-1.25 * std::pow(peak / w, 4)) * std::pow(3.3, bump);
}

// Integral over wave vectors, by lengths and directions.
double integral(const std::function<double(double kx, double kz)>& f, double shortest, double longest) {
  constexpr int kLengths = 1500, kDirections = 72;
  const double ratio = std::log(longest / shortest) / kLengths;
  double sum = 0;
  for (int i = 0; i < kLengths; ++i) {
    const double k = shortest * std::exp((i + 0.5) * ratio);
    for (int j = 0; j < kDirections; ++j) {
      const double to = 2 * pi * (j + 0.5) / kDirections;
      sum += f(k * std::cos(to), k * std::sin(to)) * k * k * ratio * (2 * pi / kDirections);
    }
  }
  return sum;
}

double totalVariance(const Spectrum& s) {
  return integral([&](double kx, double kz) { return density(s, kx, kz); }, 1e-4, 1e3);
}

TEST(OceanSpectrum, frequencyIsThatOfWaterInDeepAndShallow) {
  Spectrum s;
  EXPECT_NEAR(waterFrequency(s, 0.1), std::sqrt(9.81 * 0.1), 1e-9);
  s.depth = 1;
  EXPECT_NEAR(waterFrequency(s, 0.01), 0.01 * std::sqrt(9.81 * 1), 1e-5);  // long waves: all as fast
  EXPECT_NEAR(waterFrequency(s, 2), std::sqrt(9.81 * 2 * std::tanh(2.0)), 1e-9);
}

TEST(OceanSpectrum, cyclesAreRoundedDownAndNeverNone) {
  Spectrum s;
  for (const double loop : {1.0, 7.5, 20.0, 600.0})
    for (double k = 1e-3; k < 100; k *= 1.07) {
      s.loop = loop;
      const double exact = waterFrequency(s, k) * loop / (2 * pi);
      const uint32_t whole = cycles(s, k);
      EXPECT_GE(whole, 1u);
      EXPECT_TRUE(exact < 1 || (whole <= exact && exact < whole + 1)) << loop << " " << k;
    }
}

TEST(OceanSpectrum, jonswapOverAllDirectionsIsThePapers) {
  Spectrum s;
  s.smallest = 0;
  for (const double wind : {8.0, 10.0, 20.0}) {  // those that 100 km are not enough for
    s.wind = wind;
    for (const double w : {0.5, 0.9, 1.0, 1.1, 2.0, 4.0}) {
      const double k = w * w / 9.81, groupSpeed = 9.81 / (2 * w);
      double sum = 0;
      for (int j = 0; j < 360; ++j) sum += density(s, k * std::cos(j * pi / 180), k * std::sin(j * pi / 180));
      const double expected = jonswapOf(w, wind, 100e3) * groupSpeed;
      EXPECT_NEAR(sum * k * pi / 180, expected, 1e-6 * expected + 1e-12) << wind << " " << w;
    }
  }
}

TEST(OceanSpectrum, heightsArePlausible) {
  Spectrum s;
  s.smallest = 0;
  const double significant = 4 * std::sqrt(totalVariance(s));
  EXPECT_GT(significant, 1.9);
  EXPECT_LT(significant, 2.2);
  double direct = 0;
  for (double w = 0.3; w < 100; w += 1e-3) direct += jonswapOf(w + 5e-4, 10, 100e3) * 1e-3;
  EXPECT_NEAR(significant, 4 * std::sqrt(direct), 1e-3);

  // Fully grown seas by wind: Pierson and Moskowitz have 0.21 wind^2 / g; with JONSWAP's peak it is more.
  for (const double wind : {5.0, 10.0, 30.0}) {
    s.wind = wind;
    s.kind = Spectrum::phillips;
    EXPECT_NEAR(totalVariance(s), 0.0081 / 4 * std::pow(wind * wind / 9.81, 2), 1e-3 * totalVariance(s));
    EXPECT_NEAR(4 * std::sqrt(totalVariance(s)) * 9.81 / (wind * wind), 0.21, 0.04);
    s.kind = Spectrum::jonswap;
    s.fetch = 10000;
    EXPECT_NEAR(4 * std::sqrt(totalVariance(s)) * 9.81 / (wind * wind), 0.28, 0.03);
  }
}

TEST(OceanSpectrum, heightIsAFactorAndSmallWavesAreDamped) {
  for (const auto kind : {Spectrum::phillips, Spectrum::jonswap}) {
    Spectrum s, other;
    s.kind = other.kind = kind;
    s.smallest = other.smallest = 0;
    other.height = 3;
    EXPECT_NEAR(density(other, 0.2, 0.1), 9 * density(s, 0.2, 0.1), 1e-9);
    other = s;
    other.smallest = 2;
    EXPECT_NEAR(density(other, pi, 0), density(s, pi, 0) / std::numbers::e, 1e-12);
    EXPECT_LT(density(other, 4 * pi, 0), density(s, 4 * pi, 0) * 1e-6);
    EXPECT_GT(density(other, 0.1, 0), density(s, 0.1, 0) * 0.99);
  }
}

TEST(OceanSpectrum, wavesGoWithTheWind) {
  Spectrum s;
  for (const double direction : {0.0, 90.0, 200.0}) {
    s.windDirection = direction;
    const double x = std::cos(direction * pi / 180), z = std::sin(direction * pi / 180), k = 0.15;
    const double along = density(s, k * x, k * z);
    EXPECT_NEAR(density(s, -k * x, -k * z), 0.01 * along, 1e-9);
    EXPECT_NEAR(density(s, -k * z, k * x), 0, 1e-9 * along);
    const double c = std::sqrt(0.5);
    EXPECT_NEAR(density(s, k * c * (x - z), k * c * (z + x)), 0.5 * along, 1e-9);
  }
}

TEST(OceanSpectrum, shallowWaterLowersHeights) {
  for (const auto kind : {Spectrum::phillips, Spectrum::jonswap}) {
    Spectrum s;
    s.kind = kind;
    s.wind = 20;
    s.smallest = 0;
    double last = totalVariance(s);
    for (const double depth : {10.0, 3.0, 1.0, 0.1}) {
      s.depth = depth;
      const double variance = totalVariance(s);
      EXPECT_LT(variance, 0.7 * last) << depth;
      last = variance;
    }
  }
  // Where all waves are as fast, w = k sqrt(g d), Phillips' integral has a closed form.
  Spectrum s;
  s.kind = Spectrum::phillips;
  s.wind = 40;
  s.depth = 0.1;
  EXPECT_NEAR(totalVariance(s), 0.0081 * std::sqrt(pi) * 40 * 40 * 0.1 / (8 * 9.81), 0.05 * totalVariance(s));
}

// A wave's share is an integral, not a sample.
TEST(OceanSpectrum, wavesHaveTheDensitysIntegral) {
  Spectrum s;
  s.tile = 90;
  for (const auto& [x, z] : {std::pair(1, 0), {1, 1}, {-2, 1}, {5, 3}, {20, -9}}) {
    constexpr int kParts = 400;
    const double step = 2 * pi / s.tile;
    double sum = 0;
    for (int j = 0; j < kParts; ++j)
      for (int i = 0; i < kParts; ++i)
        sum += density(s, step * (x - 0.5 + (i + 0.5) / kParts), step * (z - 0.5 + (j + 0.5) / kParts));
    sum *= step * step / (kParts * kParts);
    EXPECT_NEAR(waveVariance(s, x, z), sum, 4e-3 * sum) << x << " " << z;
  }
  EXPECT_EQ(waveVariance(s, 0, 0), 0);
}

TEST(OceanSpectrum, noKnobMakesItGoWrong) {
  Spectrum s;
  for (const auto kind : {Spectrum::phillips, Spectrum::jonswap})
    for (const double wind : {0.0, 1e-300, 1e-9, 0.1, 60.0})
      for (const double depth : {0.1, 10000.0})
        for (const double fetch : {1.0, 10000.0})
          for (const double tile : {1.0, 10000.0})
            for (const auto& [x, z] : {std::pair(1, 0), {0, 1}, {127, -127}}) {
              s.kind = kind, s.wind = wind, s.depth = depth, s.fetch = fetch, s.tile = tile;
              const double variance = waveVariance(s, x, z);
              EXPECT_TRUE(variance >= 0 && variance < 1e4)
                  << variance << " wind " << wind << " depth " << depth << " fetch " << fetch;
            }
}

TEST(OceanSpectrum, gaussianIsNormalAndIndependent) {
  double sum = 0, squares = 0, fourth = 0, neighbours = 0, seeds = 0, parts = 0;
  int count = 0;
  for (int x = -127; x <= 127; ++x)
    for (int z = -127; z <= 127; ++z, ++count) {
      const std::complex<double> g = waveGaussian(7, x, z);
      sum += g.real() + g.imag();
      squares += std::norm(g);
      fourth += std::pow(g.real(), 4) + std::pow(g.imag(), 4);
      parts += g.real() * g.imag();
      neighbours += (std::conj(g) * waveGaussian(7, x + 1, z)).real();
      seeds += (std::conj(g) * waveGaussian(8, x, z)).real();
    }
  EXPECT_NEAR(sum / count, 0, 0.02);
  EXPECT_NEAR(squares / count, 1, 0.02);
  EXPECT_NEAR(fourth / count, 2 * 3 * 0.25, 0.06);  // a normal number's fourth moment is 3 variance^2
  EXPECT_NEAR(parts / count, 0, 0.02);
  EXPECT_NEAR(neighbours / count, 0, 0.02);
  EXPECT_NEAR(seeds / count, 0, 0.02);
}

}  // namespace
}  // namespace scumble::ocean
