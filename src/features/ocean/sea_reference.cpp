#include "features/ocean/sea_reference.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "features/ocean/waves/spectrum.h"

namespace scumble::test {

namespace {

constexpr double kPi = std::numbers::pi, kGravity = 9.81;

// JONSWAP, over wave vectors: m^2 / (rad/m)^2.
double jonswap(const SeaState& s, const glm::dvec2& k) {
  const double length = glm::length(k), w = std::sqrt(kGravity * length);
  const double x = kGravity * 1000 * s.fetch / (s.wind * s.wind);
  const double peak = 22 * std::pow(x, -1.0 / 3) * kGravity / s.wind, width = w < peak ? 0.07 : 0.09;
  const double peaked = std::pow(3.3, std::exp(-std::pow((w / peak - 1) / width, 2) / 2));
  const double shape = std::exp(-1.25 * std::pow(peak / w, 4)) * peaked;
  const double to = glm::radians(s.windDirection);
  const double cosine = (k.x * std::cos(to) + k.y * std::sin(to)) / length;
  // Over all directions one.
  const double spread = 2 / (1.01 * kPi) * cosine * cosine * (cosine < 0 ? 0.01 : 1.0);
  const double small = std::exp(-std::pow(length * s.smallest / (2 * kPi), 2));
  return 0.076 * std::pow(x, -0.22) / (2 * std::pow(length, 4)) * shape * spread * small * s.height *
         s.height;
}

// Over the square of wave vectors around one: m^2.
double varianceOf(const SeaState& s, int x, int z) {
  constexpr int kParts = 24;
  const double step = 2 * kPi / s.tile;
  double sum = 0;
  for (int i = 0; i < kParts; ++i)
    for (int j = 0; j < kParts; ++j)
      sum += jonswap(s, step * glm::dvec2(x + (i + 0.5) / kParts - 0.5, z + (j + 0.5) / kParts - 0.5));
  return sum * step * step / (kParts * kParts);
}

}  // namespace

SeaReference::SeaReference(const SeaState& state, double seconds) : state_(state) {
  const int last = (state.grid - 1) / 2;
  const double step = 2 * kPi / state.tile, slowest = 2 * kPi / state.loop;
  const int side = 2 * last + 1;
  std::vector<double> variances;
  for (int i = 0; i < side * side; ++i)
    variances.push_back(2 * i + 1 == side * side ? 0 : varianceOf(state, i % side - last, i / side - last));
  double variance = 0;
  for (int z = -last; z <= last; ++z)
    for (int x = -last; x <= last; ++x) {
      if (x == 0 && z == 0) continue;
      const auto varianceAt = [&](int i, int j) { return variances[size_t((j + last) * side + i + last)]; };
      const glm::dvec2 k = step * glm::dvec2(x, z);
      const double w =
          slowest * std::max(1.0, std::floor(std::sqrt(kGravity * glm::length(k)) / slowest + 1e-9));
      const auto h0 = [&](int i, int j) {
        return std::sqrt(varianceAt(i, j) / 2) * ocean::waveGaussian(state.seed, i, j);
      };
      waves_.push_back({k, h0(x, z) * std::polar(1.0, -w * seconds) +
                               std::conj(h0(-x, -z)) * std::polar(1.0, w * seconds)});
      variance += varianceAt(x, z);
    }
  deviation_ = std::sqrt(variance);
}

glm::dvec3 SeaReference::at(double x, double z) const {
  glm::dvec3 sum(x, 0, z);
  for (const Wave& wave : waves_) {
    const std::complex<double> here = wave.size * std::polar(1.0, wave.k.x * x + wave.k.y * z);
    // The real part of i times it.
    const double turned = -here.imag() * state_.choppiness / glm::length(wave.k);
    sum += glm::dvec3(turned * wave.k.x, here.real(), turned * wave.k.y);
  }
  return sum;
}

glm::dvec3 SeaReference::across(double x, double z) const {
  constexpr double kStep = 1e-3;  // metres
  const glm::dvec3 alongX = (at(x + kStep, z) - at(x - kStep, z)) / (2 * kStep),
                   alongZ = (at(x, z + kStep) - at(x, z - kStep)) / (2 * kStep);
  return glm::cross(alongZ, alongX);
}

SeaReference::Mesh SeaReference::mesh(int half, const glm::dvec2& travelled) const {
  const double cell = state_.tile / state_.grid;
  const glm::ivec2 middle = glm::round(travelled / cell);
  const int side = 2 * half + 1;
  std::vector<Corner> points;
  for (int j = -half; j <= half; ++j)
    for (int i = -half; i <= half; ++i) {
      const glm::dvec2 rest = glm::dvec2(middle + glm::ivec2(i, j)) * cell;
      const glm::dvec3 moved = at(rest.x, rest.y), normal = across(rest.x, rest.y);
      points.push_back(
          {moved - glm::dvec3(travelled.x, 0, travelled.y), glm::normalize(normal), moved.y, normal.y});
    }
  Mesh mesh;
  const auto add = [&](const glm::ivec2& a, const glm::ivec2& b, const glm::ivec2& c) {
    WorldTriangle triangle;
    int corner = 0;
    for (const glm::ivec2& p : {a, b, c}) {
      mesh.corners.push_back(points[size_t(p.y * side + p.x)]);
      triangle.positions[corner] = mesh.corners.back().at;
      triangle.normals[corner++] = mesh.corners.back().normal;
    }
    triangle.outward = glm::cross(triangle.positions[1] - triangle.positions[0],
                                  triangle.positions[2] - triangle.positions[0]);
    mesh.triangles.push_back(triangle);
  };
  for (int j = 0; j + 1 < side; ++j)
    for (int i = 0; i + 1 < side; ++i) {
      add({i, j}, {i, j + 1}, {i + 1, j + 1});
      add({i, j}, {i + 1, j + 1}, {i + 1, j});
    }
  return mesh;
}

}  // namespace scumble::test
