#include "base/nested_marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "base/tileable_noise.h"

namespace scumble {

namespace {

constexpr uint32_t kSize = 256;
constexpr glm::dvec2 kRadii(9.0 / kSize,
                            20.0 / kSize);  // about a mark's, and half of what neighbours keep free
constexpr double kLeast = 1.0,
                 kEnough = 1.6;  // room of a mark, in radii; of two that have enough no one is better
constexpr size_t kMarks = 130;   // at least

// Fractions that doubling, without what is whole, takes around.
using Orbit = std::vector<double>;

std::vector<Orbit> orbits() {
  std::vector<Orbit> found{{0.0}};
  // Short ones, so that marks of one of them know few rows and columns.
  for (const int denominator : {3, 5, 7, 9, 15, 17, 21, 31}) {
    std::vector<bool> isSeen(size_t(denominator), false);
    for (int first = 1; first < denominator; ++first) {
      // Fractions of a smaller denominator are known.
      if (isSeen[size_t(first)] || std::gcd(first, denominator) > 1) continue;
      Orbit orbit;
      for (int at = first; !isSeen[size_t(at)]; at = 2 * at % denominator) {
        isSeen[size_t(at)] = true;
        orbit.push_back(double(at) / denominator);
      }
      found.push_back(std::move(orbit));
    }
  }
  return found;
}

// From one place to another where the texture repeats, in radii.
glm::dvec2 way(const glm::dvec2& from, const glm::dvec2& to) {
  return (to - from - glm::round(to - from)) / kRadii;
}

// All places of an orbit along u and one along v.
struct Grid {
  std::vector<glm::dvec2> places;
  double room = std::numeric_limits<double>::max();  // from any of them to the next of all
};

double roomBetween(const std::vector<glm::dvec2>& some, const std::vector<glm::dvec2>& others) {
  double room = std::numeric_limits<double>::max();
  for (const glm::dvec2& one : some)
    for (const glm::dvec2& other : others)
      if (one != other) room = std::min(room, glm::length(way(one, other)));
  return room;
}

}  // namespace

std::vector<glm::dvec2> nestedPlaces() {
  std::vector<Grid> grids;
  const std::vector<Orbit> all = orbits();
  for (const Orbit& alongU : all)
    for (const Orbit& alongV : all) {
      Grid grid;
      for (const double u : alongU)
        for (const double v : alongV) grid.places.push_back({u, v});
      grid.room = roomBetween(grid.places, grid.places);
      grids.push_back(std::move(grid));
    }
  // Again and again the one that has room, up to what is enough; of several the smallest.
  std::vector<glm::dvec2> places;
  while (places.size() < kMarks) {
    const auto isBetter = [](const Grid& a, const Grid& b) {
      const double roomA = std::min(a.room, kEnough), roomB = std::min(b.room, kEnough);
      return roomA != roomB ? roomA > roomB : a.places.size() < b.places.size();
    };
    const auto best = std::min_element(grids.begin(), grids.end(), isBetter);
    if (best == grids.end() || best->room < kLeast) break;
    const std::vector<glm::dvec2> added = std::move(best->places);
    grids.erase(best);
    for (Grid& grid : grids) grid.room = std::min(grid.room, roomBetween(grid.places, added));
    places.insert(places.end(), added.begin(), added.end());
  }
  return places;
}

Pixels nestedMarks() {
  std::vector<double> heights(size_t(kSize) * kSize, 0.0);
  uint32_t number = 0;
  for (const glm::dvec2& place : nestedPlaces()) {
    const auto random = [&](double from, double to) {
      return from + (to - from) * double(hash(number++) & 0xFFFF) / 65535.0;
    };
    // Its middle strays from its place by less than it reaches.
    const glm::dvec2 middle = place + kRadii * glm::dvec2{random(-0.2, 0.2), random(-0.2, 0.2)};
    const double size = random(0.48, 0.68), slant = random(-0.25, 0.25);
    std::array<glm::dvec2, 4> lobes;  // depth and phase
    for (glm::dvec2& lobe : lobes) lobe = {random(0.02, 0.09), random(0, 6.2831853)};
    for (uint32_t y = 0; y < kSize; ++y)
      for (uint32_t x = 0; x < kSize; ++x) {
        glm::dvec2 off = way(middle, glm::dvec2(x + 0.5, y + 0.5) / double(kSize));
        if (std::max(std::abs(off.x), std::abs(off.y)) > 3) continue;
        off.x += slant * off.y;
        const double angle = std::atan2(off.y, off.x);
        double reach = 1;
        for (size_t k = 0; k < lobes.size(); ++k)
          reach += lobes[k].x * std::cos(double(k + 1) * angle + lobes[k].y);
        const double height = 0.5 + 0.5 * std::tanh(2.2 * (1 - glm::length(off) / (size * reach)));
        double& most = heights[size_t(y) * kSize + x];
        most = std::max(most, height);
      }
  }
  Pixels pixels{kSize, kSize, std::vector<uint8_t>(heights.size() * 4, 255)};
  for (size_t i = 0; i < heights.size(); ++i)
    for (size_t c = 0; c < 3; ++c) pixels.rgba[4 * i + c] = uint8_t(std::lround(255 * heights[i]));
  return pixels;
}

}  // namespace scumble
