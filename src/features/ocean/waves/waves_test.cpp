#include "features/ocean/waves/waves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <thread>

namespace scumble::ocean {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

WaveField fieldAt(const Spectrum& spectrum, double seconds) {
  WaveField field;
  Waves(spectrum).at(seconds, field);
  return field;
}

double meanSquare(const WaveField& field) {
  double sum = 0;
  for (const glm::vec4& d : field.displacement) sum += double(d.y) * d.y;
  return sum / double(field.displacement.size());
}

double rms(const WaveField& field) {
  return std::sqrt(meanSquare(field));
}

// h(k, t) of Tessendorf's eq. 26, for waves that travel along k.
Complex heightOf(const Spectrum& s, double seconds, int x, int z) {
  const double k = 2 * pi / s.tile * std::hypot(x, z), w = 2 * pi * cycles(s, k) / s.loop;
  const auto h0 = [&](int i, int j) { return amplitude(s, waveVariance(s, i, j), i, j); };
  return h0(x, z) * std::polar(1.0, -w * seconds) + std::conj(h0(-x, -z)) * std::polar(1.0, w * seconds);
}

struct Sum {
  double height = 0, x = 0, z = 0, slopeX = 0, slopeZ = 0, xx = 0, zz = 0, xz = 0;
};

// Eqs. 19, 20 and 29 wave by wave.
std::vector<Sum> directSum(const Spectrum& s, double seconds) {
  const int grid = s.grid, last = (grid - 1) / 2;
  std::vector<Sum> sums(size_t(grid) * size_t(grid));
  std::vector<Complex> turn;
  for (int i = 0; i < grid; ++i) turn.push_back(std::polar(1.0, 2 * pi * i / grid));
  for (int kz = -last; kz <= last; ++kz)
    for (int kx = -last; kx <= last; ++kx) {
      if (kx == 0 && kz == 0) continue;
      const Complex h = heightOf(s, seconds, kx, kz), i(0, 1);
      const double x = 2 * pi / s.tile * kx, z = 2 * pi / s.tile * kz, k = std::hypot(x, z);
      const double c = s.choppiness;
      for (int pz = 0; pz < grid; ++pz)
        for (int px = 0; px < grid; ++px) {
          const Complex at = h * turn[size_t(((px * kx + pz * kz) % grid + grid) % grid)];
          Sum& sum = sums[size_t(pz * grid + px)];
          sum.height += at.real();
          sum.slopeX += (i * x * at).real();
          sum.slopeZ += (i * z * at).real();
          sum.x += (i * c * x / k * at).real();
          sum.z += (i * c * z / k * at).real();
          sum.xx += (-c * x * x / k * at).real();
          sum.zz += (-c * z * z / k * at).real();
          sum.xz += (-c * x * z / k * at).real();
        }
    }
  return sums;
}

TEST(Waves, areTheSumOfTheirWaves) {
  for (const int grid : {1, 2, 7, 16, 45})
    for (const auto kind : {Spectrum::phillips, Spectrum::jonswap}) {
      Spectrum s;
      s.grid = grid;
      s.kind = kind;
      s.windDirection = 30;
      s.choppiness = 1.3;
      s.seed = uint32_t(grid);
      for (const double seconds : {0.0, 3.7, -101.3}) {
        const WaveField field = fieldAt(s, seconds);
        const std::vector<Sum> sums = directSum(s, seconds);
        ASSERT_EQ(field.displacement.size(), sums.size());
        const float near = 1e-6f * float(1 + 20 * std::sqrt(Waves(s).variance()));
        for (size_t i = 0; i < sums.size(); ++i) {
          ASSERT_NEAR(field.displacement[i].y, sums[i].height, near) << grid << " " << i;
          ASSERT_NEAR(field.displacement[i].x, sums[i].x, near);
          ASSERT_NEAR(field.displacement[i].z, sums[i].z, near);
          ASSERT_NEAR(field.slopes[i].x, sums[i].slopeX, near);
          ASSERT_NEAR(field.slopes[i].y, sums[i].slopeZ, near);
          const double jacobian = (1 + sums[i].xx) * (1 + sums[i].zz) - sums[i].xz * sums[i].xz;
          ASSERT_NEAR(field.displacement[i].w, jacobian, 3 * near);
        }
      }
    }
}

TEST(Waves, repeatAfterTheirLoop) {
  for (const double loop : {1.0, 7.3, 20.0, 600.0}) {
    Spectrum s;
    s.loop = loop;
    const Waves waves(s);
    WaveField now, later, between;
    waves.at(2.9, now);
    waves.at(2.9 + 5 * loop, later);
    waves.at(2.9 + 0.31 * loop, between);
    float apart = 0;
    for (size_t i = 0; i < now.displacement.size(); ++i) {
      const float near = 1e-5f * float(rms(now));
      ASSERT_NEAR(glm::distance(glm::vec3(now.displacement[i]), glm::vec3(later.displacement[i])), 0, near);
      ASSERT_NEAR(now.displacement[i].w, later.displacement[i].w, 1e-5f);
      apart = std::max(apart, std::abs(now.displacement[i].y - between.displacement[i].y));
    }
    EXPECT_GT(apart, 0.5 * rms(now)) << loop;
  }
}

// The density's integral over all wave vectors that tile and grid hold: a square with a hole in its middle.
TEST(Waves, varianceIsTheSpectrumsIntegral) {
  for (const auto kind : {Spectrum::phillips, Spectrum::jonswap})
    for (const auto& [grid, tile] : {std::pair(80, 60.0), {33, 200.0}, {64, 1000.0}}) {
      Spectrum s;
      s.grid = grid;
      s.tile = tile;
      s.kind = kind;
      s.windDirection = 25;
      const double step = 2 * pi / tile, inner = 0.5 * step, outer = (lastWave(s) + 0.5) * step;
      constexpr int kLengths = 1200, kDirections = 480;
      const double ratio = std::log(std::sqrt(2.0) * outer / inner) / kLengths;
      double sum = 0;
      for (int i = 0; i < kLengths; ++i)
        for (int j = 0; j < kDirections; ++j) {
          const double k = inner * std::exp((i + 0.5) * ratio), to = 2 * pi * (j + 0.5) / kDirections;
          const double x = k * std::cos(to), z = k * std::sin(to);
          const double larger = std::max(std::abs(x), std::abs(z));
          if (larger > inner && larger < outer)
            sum += density(s, x, z) * k * k * ratio * (2 * pi / kDirections);
        }
      EXPECT_NEAR(Waves(s).variance(), sum, 5e-3 * sum) << kind << " " << grid;
    }
}

TEST(Waves, gridsHaveTheVarianceThatIsPromised) {
  for (const auto kind : {Spectrum::phillips, Spectrum::jonswap}) {
    Spectrum s;
    s.grid = 24;
    s.tile = 150;
    s.kind = kind;
    constexpr int kSeeds = 300;
    double measured = 0;
    for (int i = 0; i < kSeeds; ++i) {
      s.seed = uint32_t(i);
      measured += meanSquare(fieldAt(s, i * 1.7)) / kSeeds;
    }
    EXPECT_NEAR(measured, Waves(s).variance(), 0.04 * measured) << kind;
  }
}

// Over a whole loop a seed's waves have what their amplitudes say, since none of them stands still; also
// where the loop is so short that most must be kept from it.
TEST(Waves, varianceOverALoopIsThatOfTheAmplitudes) {
  for (const double loop : {1.0, 20.0}) {
    Spectrum s;
    s.grid = 31;
    s.loop = loop;
    const int last = lastWave(s);
    double expected = 0;
    for (int z = -last; z <= last; ++z)
      for (int x = -last; x <= last; ++x)
        expected += 2 * std::norm(amplitude(s, waveVariance(s, x, z), x, z));
    constexpr int kTimes = 211;  // more than twice the cycles of any wave
    const Waves waves(s);
    WaveField field;
    double measured = 0;
    for (int i = 0; i < kTimes; ++i) {
      waves.at(loop * i / kTimes, field);
      measured += meanSquare(field) / kTimes;
    }
    EXPECT_NEAR(measured, expected, 1e-5 * expected) << loop;
  }
}

TEST(Waves, travelWithTheWind) {
  for (const double direction : {0.0, 90.0, 200.0}) {
    Spectrum s;
    s.windDirection = direction;
    const Waves waves(s);
    WaveField before, now, after;
    waves.at(4.95, before);
    waves.at(5, now);
    waves.at(5.05, after);
    const double x = std::cos(direction * pi / 180), z = std::sin(direction * pi / 180);
    double together = 0, rises = 0, slopes = 0;
    for (size_t i = 0; i < now.slopes.size(); ++i) {
      const double rise = (after.displacement[i].y - before.displacement[i].y) / 0.1;
      const double slope = now.slopes[i].x * x + now.slopes[i].y * z;
      together += rise * slope, rises += rise * rise, slopes += slope * slope;
    }
    EXPECT_LT(together / std::sqrt(rises * slopes), -0.7) << direction;
  }
}

TEST(Waves, choppinessDrawsWaterToCrests) {
  Spectrum s;
  const WaveField field = fieldAt(s, 1);
  double together = 0;
  for (const glm::vec4& d : field.displacement) together += d.y * (d.w - 1);
  EXPECT_LT(together, 0);

  Spectrum flat = s;
  flat.choppiness = 0;
  const WaveField upright = fieldAt(flat, 1);
  for (size_t i = 0; i < field.displacement.size(); ++i) {
    EXPECT_EQ(upright.displacement[i].x, 0);
    EXPECT_EQ(upright.displacement[i].z, 0);
    EXPECT_EQ(upright.displacement[i].w, 1);
    ASSERT_NEAR(upright.displacement[i].y, field.displacement[i].y, 1e-6);
    ASSERT_NEAR(upright.slopes[i].x, field.slopes[i].x, 1e-6);
    const glm::vec3 slopes = -upright.normals[i] / upright.normals[i].y;
    ASSERT_NEAR(slopes.x, upright.slopes[i].x, 1e-5);
    ASSERT_NEAR(slopes.z, upright.slopes[i].y, 1e-5);
  }
  EXPECT_EQ(upright.greatestShift, glm::vec2(0));
}

TEST(Waves, shiftsAreBounds) {
  const WaveField field = fieldAt({}, 8);
  glm::vec2 least(1e9f), greatest(-1e9f);
  for (const glm::vec4& d : field.displacement) {
    least = glm::min(least, glm::vec2(d.x, d.z));
    greatest = glm::max(greatest, glm::vec2(d.x, d.z));
  }
  EXPECT_EQ(field.leastShift, least);
  EXPECT_EQ(field.greatestShift, greatest);
}

// Without small waves the grid is so fine that differences between neighbours are derivatives.
TEST(Waves, slopesAndJacobianAreDerivatives) {
  Spectrum s;
  s.grid = 240;
  s.smallest = 15;
  s.choppiness = 1.4;
  const WaveField field = fieldAt(s, 12);
  const double cell = s.tile / s.grid;
  const auto at = [&](int x, int z) {
    return glm::dvec4(field.displacement[size_t((z + 240) % 240 * 240 + (x + 240) % 240)]);
  };
  // Of fourth order.
  const auto change = [&](int x, int z, int dx, int dz) {
    return (8.0 * (at(x + dx, z + dz) - at(x - dx, z - dz)) -
            (at(x + 2 * dx, z + 2 * dz) - at(x - 2 * dx, z - 2 * dz))) /
           (12 * cell);
  };
  double steepest = 0, pressed = 0;
  for (int z = 0; z < 240; z += 3)
    for (int x = 0; x < 240; x += 3) {
      const glm::dvec4 alongX = change(x, z, 1, 0), alongZ = change(x, z, 0, 1);
      const glm::vec2 slope = field.slopes[size_t(z * 240 + x)];
      ASSERT_NEAR(slope.x, alongX.y, 1e-4);
      ASSERT_NEAR(slope.y, alongZ.y, 1e-4);
      const double jacobian = (1 + alongX.x) * (1 + alongZ.z) - alongX.z * alongZ.x;
      ASSERT_NEAR(at(x, z).w, jacobian, 2e-4);
      const glm::dvec3 normal = glm::normalize(
          glm::cross(glm::dvec3(alongZ) + glm::dvec3(0, 0, 1), glm::dvec3(alongX) + glm::dvec3(1, 0, 0)));
      ASSERT_NEAR(glm::distance(glm::dvec3(field.normals[size_t(z * 240 + x)]), normal), 0, 3e-4);
      steepest = std::max(steepest, std::abs(alongX.y));
      pressed = std::max(pressed, std::abs(jacobian - 1));
    }
  EXPECT_GT(steepest, 0.05);
  EXPECT_GT(pressed, 0.05);
}

TEST(Waves, calmIsFlatToTheBit) {
  const auto expectCalm = [](const Spectrum& s) {
    const WaveField field = fieldAt(s, 3);
    ASSERT_EQ(field.displacement.size(), size_t(s.grid) * size_t(s.grid));
    for (const glm::vec4& d : field.displacement) ASSERT_EQ(d, glm::vec4(0, 0, 0, 1));
    for (const glm::vec2& slope : field.slopes) ASSERT_EQ(slope, glm::vec2(0));
    for (const glm::vec3& normal : field.normals) ASSERT_EQ(normal, glm::vec3(0, 1, 0));
    EXPECT_EQ(Waves(s).variance(), 0);
  };
  Spectrum s;
  s.wind = 0;
  expectCalm(s);
  s.kind = Spectrum::phillips;
  expectCalm(s);
  s = {};
  s.height = 0;
  expectCalm(s);
  s = {};
  s.grid = 1;
  expectCalm(s);
  s.grid = 2;
  expectCalm(s);
}

TEST(Waves, noKnobMakesThemGoWrong) {
  Spectrum s;
  for (const int grid : {3, 10, 13})
    for (const auto kind : {Spectrum::phillips, Spectrum::jonswap})
      for (const double tile : {1.0, 10000.0})
        for (const double loop : {1.0, 600.0})
          for (const double wind : {1e-3, 60.0})
            for (const double depth : {0.1, 10000.0})
              for (const double fetch : {1.0, 10000.0})
                for (const double smallest : {0.0, 100.0}) {
                  s = {grid, tile, kind, wind, 77, fetch, 2, depth, loop, 50, smallest, 3};
                  const WaveField field = fieldAt(s, 1e7);
                  for (size_t i = 0; i < field.displacement.size(); ++i)
                    for (int c = 0; c < 4; ++c)
                      ASSERT_TRUE(std::isfinite(field.displacement[i][c]) &&
                                  std::isfinite(field.slopes[i][c % 2]));
                }
}

TEST(Waves, areTheSameEveryTimeAndOnEveryMachine) {
  Spectrum s;
  s.grid = 20;
  s.seed = 42;
  const WaveField field = fieldAt(s, 5);
  EXPECT_EQ(field.displacement, fieldAt(s, 5).displacement);
  // From a second implementation, in Python.
  EXPECT_NEAR(waveGaussian(42, 3, -2).real(), -0.2853483067234057, 1e-12);
  EXPECT_NEAR(waveGaussian(42, 3, -2).imag(), -0.3536840898510485, 1e-12);
  // As it was when this was written: pictures depend on it.
  const std::pair<size_t, glm::vec4> pinned[] = {
      {0, {0.25538307f, 0.06140237f, 0.52030778f, 0.94132704f}},
      {123, {-0.52863157f, 0.85156597f, -0.34789079f, 0.91520882f}},
  };
  for (const auto& [i, expected] : pinned)
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(field.displacement[i][c], expected[c], 1e-5) << i << " " << c;

  s.seed = 43;
  const WaveField other = fieldAt(s, 5);
  double product = 0;
  for (size_t i = 0; i < 400; ++i) product += field.displacement[i].y * other.displacement[i].y / 400;
  EXPECT_LT(std::abs(product), 0.7 * rms(field) * rms(other));
}

// Each long wave's amplitude is read off both fields.
TEST(Waves, longWavesStayWhenTheGridChanges) {
  const auto waveIn = [](const WaveField& field, int x, int z) {
    Complex sum = 0;
    for (int j = 0; j < field.grid; ++j)
      for (int i = 0; i < field.grid; ++i)
        sum += double(field.displacement[size_t(j * field.grid + i)].y) *
               std::polar(1.0, -2 * pi * (x * i + z * j) / field.grid);
    return sum / double(field.grid * field.grid);
  };
  Spectrum s;
  s.grid = 16;
  const WaveField coarse = fieldAt(s, 6);
  for (const int grid : {17, 45, 80}) {
    s.grid = grid;
    const WaveField fine = fieldAt(s, 6);
    for (const auto& [x, z] : {std::pair(1, 0), {0, 1}, {3, -2}, {-7, 7}, {7, 7}, {5, 0}})
      EXPECT_NEAR(std::abs(waveIn(coarse, x, z) - waveIn(fine, x, z)), 0, 1e-6)
          << grid << " " << x << " " << z;
  }
}

TEST(Waves, threadsMayShareThem) {
  Spectrum s;
  s.grid = 77;  // 7 and 11: kissfft's general butterfly, the one with scratch memory
  const Waves waves(s);
  WaveField alone[2], together[2];
  for (int i = 0; i < 2; ++i) waves.at(i, alone[i]);
  for (int repeat = 0; repeat < 10; ++repeat) {
    std::thread other([&] { waves.at(0, together[0]); });
    waves.at(1, together[1]);
    other.join();
    for (int i = 0; i < 2; ++i) ASSERT_EQ(alone[i].displacement, together[i].displacement);
  }
}

}  // namespace
}  // namespace scumble::ocean
