#include "features/ocean/waves/surface.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

namespace scumble::ocean {

namespace {

// Twice the area of the triangle (0, a, b), seen from above.
double area(const glm::dvec3& a, const glm::dvec3& b) {
  return a.z * b.x - a.x * b.z;
}

struct Found {
  bool any = false;
  double height = 0;
  glm::dvec3 normal{0, 1, 0};
};

// A triangle with corners relative to a vertical line: is the line within it, and higher than what was found?
// `tolerance` (m^2) closes the gaps that rounding leaves between neighbours.
void meet(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double tolerance, Found& found) {
  double ofA = area(b, c), ofB = area(c, a), ofC = area(a, b);
  const double sign = ofA + ofB + ofC < 0 ? -1 : 1;  // turned over where folded
  ofA *= sign, ofB *= sign, ofC *= sign;
  // One that is seen edge-on; its neighbours reach as high.
  if (ofA + ofB + ofC <= 3 * tolerance) return;
  if (std::min({ofA, ofB, ofC}) < -tolerance) return;
  ofA = std::max(ofA, 0.0), ofB = std::max(ofB, 0.0), ofC = std::max(ofC, 0.0);
  const double height = (ofA * a.y + ofB * b.y + ofC * c.y) / (ofA + ofB + ofC);
  if (found.any && height <= found.height) return;
  found = {true, height, sign * glm::normalize(glm::cross(b - a, c - a))};
}

}  // namespace

SurfacePoint surfaceAt(const WaveField& field, double x, double z) {
  const int grid = field.grid;
  assert(grid >= 1 && field.displacement.size() == size_t(grid) * size_t(grid));
  const double cell = field.tile / grid;
  x -= std::floor(x / field.tile) * field.tile;
  z -= std::floor(z / field.tile) * field.tile;

  // Cells whose corners can have moved here, with a little more for rounding.
  const auto first = [&](double at, float most) { return int(std::ceil((at - most) / cell - 1 - 1e-6)); };
  const auto last = [&](double at, float least) { return int(std::floor((at - least) / cell + 1e-6)); };
  const int firstI = first(x, field.greatestShift.x), lastI = last(x, field.leastShift.x);
  const int firstJ = first(z, field.greatestShift.y), lastJ = last(z, field.leastShift.y);
  const auto wrapped = [&](int i) { return size_t((i % grid + grid) % grid); };
  const auto corner = [&](int i, int j) {
    const glm::vec4& d = field.displacement[wrapped(j) * size_t(grid) + wrapped(i)];
    return glm::dvec3(i * cell + d.x - x, d.y, j * cell + d.z - z);
  };

  Found found;
  for (int j = firstJ; j <= lastJ; ++j) {
    glm::dvec3 near = corner(firstI, j), far = corner(firstI, j + 1);
    for (int i = firstI; i <= lastI; ++i) {
      const glm::dvec3 nextNear = corner(i + 1, j), nextFar = corner(i + 1, j + 1);
      meet(near, far, nextFar, 1e-12 * cell * cell, found);
      meet(near, nextFar, nextNear, 1e-12 * cell * cell, found);
      near = nextNear, far = nextFar;
    }
  }
  // A sheet that repeats covers everything, however it is folded.
  assert(found.any);
  return {float(found.height), glm::vec3(found.normal)};
}

float heightAt(const WaveField& field, double x, double z) {
  return surfaceAt(field, x, z).height;
}

Floating floatingAt(const WaveField& field, double x, double z, double length, double beam, double heading) {
  const double cell = field.tile / field.grid;
  // As dense as the mesh, but so few that a large ship costs no more than some ten boats.
  const auto samples = [&](double metres, int most) {
    return metres > 0 ? std::clamp(int(std::ceil(metres / cell)), 3, most) : 1;
  };
  const int along = samples(length, 16), across = samples(beam, 8);
  const double to = glm::radians(heading);
  const glm::dvec3 bow(std::cos(to), 0, std::sin(to)), up(0, 1, 0), starboard = glm::cross(bow, up);

  // Samples lie evenly around the middle, so the plane's three numbers come out one by one.
  double sum = 0, sumAlong = 0, squaresAlong = 0, sumAcross = 0, squaresAcross = 0;
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < across; ++j) {
      const double a = length * ((i + 0.5) / along - 0.5), b = beam * ((j + 0.5) / across - 0.5);
      const double height = heightAt(field, x + a * bow.x + b * starboard.x, z + a * bow.z + b * starboard.z);
      sum += height;
      sumAlong += a * height, squaresAlong += a * a;
      sumAcross += b * height, squaresAcross += b * b;
    }
  const double climb = squaresAlong > 0 ? sumAlong / squaresAlong : 0;
  const double list = squaresAcross > 0 ? sumAcross / squaresAcross : 0;

  const glm::dvec3 normal = glm::normalize(up - climb * bow - list * starboard);
  const glm::dvec3 tiltedBow = glm::normalize(bow + climb * up);
  const glm::dmat3 tilted(tiltedBow, normal, glm::cross(tiltedBow, normal)), upright(bow, up, starboard);
  return {float(sum / (along * across)), glm::quat(glm::quat_cast(tilted * glm::transpose(upright)))};
}

}  // namespace scumble::ocean
