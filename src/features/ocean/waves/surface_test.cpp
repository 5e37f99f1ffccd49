#include "features/ocean/waves/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <random>

namespace scumble::ocean {
namespace {

WaveField fieldOf(const Spectrum& spectrum, double seconds) {
  WaveField field;
  Waves(spectrum).at(seconds, field);
  return field;
}

// Built by hand: `displace` gives a point's displacement by its number.
template <class Displace>
WaveField fieldOf(int grid, double tile, Displace&& displace) {
  WaveField field;
  field.grid = grid;
  field.tile = tile;
  for (int j = 0; j < grid; ++j)
    for (int i = 0; i < grid; ++i) {
      const glm::vec3 d = displace(i, j);
      field.displacement.emplace_back(d, 1);
      field.slopes.emplace_back(0);
      field.leastShift = glm::min(field.leastShift, glm::vec2(d.x, d.z));
      field.greatestShift = glm::max(field.greatestShift, glm::vec2(d.x, d.z));
    }
  return field;
}

struct WaterTriangle {
  glm::dvec3 a, b, c;
};

// Nine tiles, as a renderer would draw them.
std::vector<WaterTriangle> meshOf(const WaveField& field) {
  const int n = field.grid;
  const auto corner = [&](int i, int j) {
    const glm::dvec4 d(field.displacement[size_t((j + n) % n * n + (i + n) % n)]);
    return glm::dvec3(i * field.tile / n + d.x, d.y, j * field.tile / n + d.z);
  };
  std::vector<WaterTriangle> triangles;
  for (int j = -n; j < 2 * n; ++j)
    for (int i = -n; i < 2 * n; ++i) {
      triangles.push_back({corner(i, j), corner(i, j + 1), corner(i + 1, j + 1)});
      triangles.push_back({corner(i, j), corner(i + 1, j + 1), corner(i + 1, j)});
    }
  return triangles;
}

struct HitBelow {
  double height;
  glm::dvec3 normal;
};

// A ray from above against every triangle (Moeller and Trumbore 1997).
std::optional<HitBelow> castDown(const std::vector<WaterTriangle>& triangles, double x, double z) {
  std::optional<HitBelow> best;
  const glm::dvec3 origin(x, 1000, z), down(0, -1, 0);
  for (const WaterTriangle& t : triangles) {
    const glm::dvec3 ab = t.b - t.a, ac = t.c - t.a, p = glm::cross(down, ac);
    const double determinant = glm::dot(ab, p);
    if (std::abs(determinant) < 1e-14) continue;
    const glm::dvec3 s = (origin - t.a) / determinant, q = glm::cross(s, ab);
    const double u = glm::dot(s, p), v = glm::dot(down, q);
    if (u < -1e-9 || v < -1e-9 || u + v > 1 + 1e-9) continue;
    const double height = 1000 - glm::dot(ac, q);
    if (best && best->height >= height) continue;
    glm::dvec3 normal = glm::normalize(glm::cross(ab, ac));
    if (normal.y < 0) normal = -normal;
    best = {height, normal};
  }
  return best;
}

TEST(OceanSurface, isWhereARayMeetsTheMesh) {
  std::mt19937 random(5);
  for (const auto& [grid, choppiness, height] :
       {std::tuple(12, 0.0, 1.0), {12, 1.0, 1.0}, {17, 2.0, 2.0}, {20, 2.0, 5.0}}) {
    Spectrum s;
    s.grid = grid;
    s.tile = 30;
    s.choppiness = choppiness;
    s.height = height;
    const WaveField field = fieldOf(s, 4);
    const std::vector<WaterTriangle> mesh = meshOf(field);
    int otherNormal = 0;
    for (int i = 0; i < 500; ++i) {
      const auto number = [&] { return std::uniform_real_distribution<double>(0, 30)(random); };
      const double x = number(), z = number();
      const std::optional<HitBelow> hit = castDown(mesh, x, z);
      ASSERT_TRUE(hit);
      const SurfacePoint got = surfaceAt(field, x, z);
      ASSERT_NEAR(got.height, hit->height, 1e-5) << x << " " << z;
      otherNormal += glm::distance(glm::dvec3(got.normal), hit->normal) > 1e-5;
      EXPECT_EQ(got.height, heightAt(field, x, z));
    }
    const bool folded = std::any_of(field.displacement.begin(), field.displacement.end(),
                                    [](const glm::vec4& d) { return d.w < 0; });
    EXPECT_EQ(otherNormal, 0);
    EXPECT_EQ(folded, height > 2) << height;
  }
}

TEST(OceanSurface, hasNoGapAtCornersAndEdges) {
  for (const double height : {1.0, 6.0}) {
    Spectrum s;
    s.grid = 16;
    s.tile = 30;
    s.height = height;
    const WaveField field = fieldOf(s, 2);
    for (int j = 0; j < 16; ++j)
      for (int i = 0; i < 16; ++i) {
        const auto at = [&](int x, int z) {
          const glm::vec4& d = field.displacement[size_t(z % 16 * 16 + x % 16)];
          return glm::dvec3(x * 30.0 / 16 + d.x, d.y, z * 30.0 / 16 + d.z);
        };
        const glm::dvec3 a = at(i, j);
        for (const glm::dvec3& b : {at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)})
          for (const double t : {0.0, 0.3, 0.5}) {
            const glm::dvec3 p = glm::mix(a, b, t);
            const float found = heightAt(field, p.x, p.z);
            // Higher only where another sheet is above.
            EXPECT_GE(found, p.y - 1e-5);
            EXPECT_TRUE(height > 1 || found < p.y + 1e-5);
          }
      }
  }
}

TEST(OceanSurface, hasNoSeam) {
  Spectrum s;
  s.grid = 20;
  const WaveField field = fieldOf(s, 9);
  double steepest = 0;
  for (double z = 0; z < 60; z += 0.37) {
    const double inside = heightAt(field, 1e-7, z), outside = heightAt(field, -1e-7, z);
    EXPECT_NEAR(inside, outside, 1e-5);
    EXPECT_NEAR(heightAt(field, z, 1e-7), heightAt(field, z, -1e-7), 1e-5);
    for (const double shift : {-60.0, 60.0, 600.0, -6000.0}) {
      const SurfacePoint here = surfaceAt(field, 13.1, z), there = surfaceAt(field, 13.1 + shift, z - shift);
      EXPECT_NEAR(here.height, there.height, 1e-5);
      EXPECT_NEAR(glm::distance(here.normal, there.normal), 0, 1e-5);
    }
    steepest = std::max(steepest, std::abs(1.0 - surfaceAt(field, 13.1, z).normal.y));
  }
  EXPECT_GT(steepest, 1e-3);

  // Across the border normals turn no more than they do elsewhere between neighbouring cells.
  const double cell = 3;
  const auto turnAcross = [&](double border) {
    double turn = 0;
    for (double z = 0; z < 60; z += 0.7)
      turn = std::max(turn, double(glm::distance(surfaceAt(field, border - cell / 2, z).normal,
                                                 surfaceAt(field, border + cell / 2, z).normal)));
    return turn;
  };
  double elsewhere = 0;
  for (int i = 1; i < 20; ++i) elsewhere = std::max(elsewhere, turnAcross(i * cell));
  EXPECT_LE(turnAcross(0), elsewhere * 1.3);
}

TEST(OceanSurface, takesTheHighestSheetOfAFold) {
  // A column of points is drawn two and a half cells over its neighbours, and up.
  const WaveField field =
      fieldOf(8, 8, [](int i, int) { return i == 3 ? glm::vec3(2.5f, 2, 0) : glm::vec3(0); });
  // From x = 2 the mesh climbs to (5.5, 2) and goes back to (4, 0), under itself.
  for (const double x : {2.5, 4.0, 5.0, 5.49}) {
    const SurfacePoint point = surfaceAt(field, x, 3.3);
    EXPECT_NEAR(point.height, (x - 2) / 3.5 * 2, 1e-6) << x;
    EXPECT_GT(point.normal.y, 0);
    EXPECT_LT(point.normal.x, 0);
  }
  EXPECT_NEAR(heightAt(field, 5.51, 3.3), 0, 1e-6);
  EXPECT_NEAR(heightAt(field, 1.99, 3.3), 0, 1e-6);
}

TEST(OceanSurface, ofFewAndOfHugeWavesIsFound) {
  Spectrum s;
  s.grid = 1;
  WaveField field = fieldOf(s, 1);
  EXPECT_EQ(heightAt(field, 12, -1e5), 0);
  EXPECT_EQ(surfaceAt(field, 0, 0).normal, glm::vec3(0, 1, 0));
  s.grid = 40;
  s.wind = 0;
  field = fieldOf(s, 1);
  for (double x = -70; x < 70; x += 0.5) {
    EXPECT_EQ(heightAt(field, x, 2 * x), 0);
    EXPECT_EQ(surfaceAt(field, x, 2 * x).normal, glm::vec3(0, 1, 0));
  }
  s.wind = 60;
  s.height = 20;
  s.choppiness = 2;
  s.smallest = 0;
  field = fieldOf(s, 1);
  EXPECT_GT(field.greatestShift.x, 20);
  for (double x = -70; x < 70; x += 5) {
    const SurfacePoint point = surfaceAt(field, x, 0.3 * x);
    EXPECT_TRUE(std::isfinite(point.height) && point.normal.y >= 0);
    EXPECT_NEAR(glm::length(point.normal), 1, 1e-5);
  }
}

TEST(OceanSurface, boatsLieOnAPlane) {
  const WaveField field =
      fieldOf(64, 64, [](int i, int j) { return glm::vec3(0, 0.1f * i - 0.05f * j + 3, 0); });
  const glm::vec3 normal = glm::normalize(glm::vec3(-0.1f, 1, 0.05f));
  for (const double heading : {0.0, 90.0, 37.0, -120.0}) {
    const Floating boat = floatingAt(field, 30, 25, 12, 4, heading);
    EXPECT_NEAR(boat.height, 0.1 * 30 - 0.05 * 25 + 3, 1e-5);
    EXPECT_NEAR(glm::distance(boat.tilt * glm::vec3(0, 1, 0), normal), 0, 1e-5);
    const double to = heading * std::numbers::pi / 180;
    const glm::vec3 bow = boat.tilt * glm::vec3(std::cos(to), 0, std::sin(to));
    EXPECT_NEAR(bow.x * std::sin(to) - bow.z * std::cos(to), 0, 1e-5);
    EXPECT_NEAR(glm::length(boat.tilt), 1, 1e-5);
  }
}

TEST(OceanSurface, boatsWithoutExtentStandUpright) {
  const WaveField field = fieldOf(64, 64, [](int i, int j) { return glm::vec3(0, 0.1f * i - 0.05f * j, 0); });
  const Floating point = floatingAt(field, 30, 25, 0, 0, 50);
  EXPECT_NEAR(point.height, 0.1 * 30 - 0.05 * 25, 1e-5);
  EXPECT_NEAR(point.tilt.w, 1, 1e-6);
  const glm::vec3 up = floatingAt(field, 30, 25, 10, 0, 0).tilt * glm::vec3(0, 1, 0);
  EXPECT_NEAR(up.x / up.y, -0.1, 1e-5);
  EXPECT_NEAR(up.z, 0, 1e-6);
}

TEST(OceanSurface, longBoatsTiltLessThanShortOnes) {
  const WaveField field = fieldOf(Spectrum{}, 3);
  const auto meanTilt = [&](double length, double beam) {
    double sum = 0;
    for (int i = 0; i < 100; ++i) {
      const glm::vec3 up = floatingAt(field, i * 7.3, i * 3.1, length, beam, 20).tilt * glm::vec3(0, 1, 0);
      sum += 1 - up.y;
    }
    return sum;
  };
  const double dinghy = meanTilt(3, 1.2), sloop = meanTilt(12, 4), ship = meanTilt(60, 12);
  EXPECT_LT(sloop, dinghy);
  EXPECT_LT(ship, 0.3 * sloop);
  EXPECT_GT(ship, 0);
}

}  // namespace
}  // namespace scumble::ocean
