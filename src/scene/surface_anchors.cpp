#include "scene/surface_anchors.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace scumble::scene {

namespace {

// With fewer of them, places stay empty that a finer level fills.
constexpr double kCandidatesForPlace = 16;

// Mixes all bits (splitmix64).
uint64_t mixed(uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

// Numbers from 0 to 1 that follow from a seed.
class Numbers {
 public:
  explicit Numbers(uint64_t seed) : state_(seed) {}
  uint64_t bits() { return mixed(state_++); }
  double next() { return double(bits() >> 11) * 0x1p-53; }

 private:
  uint64_t state_;
};

struct Candidate {
  SurfaceAnchor anchor;
  glm::dvec3 position, normal;
};

glm::dvec3 outwardOf(const Primitive& primitive, size_t triangle) {
  const auto at = [&](size_t corner) {
    return glm::dvec3(primitive.positions[primitive.indices[3 * triangle + corner]]);
  };
  return glm::cross(at(1) - at(0), at(2) - at(0));
}

// Accepted points in cells as wide as what is asked about, by hash; those that share a slot are told apart by
// where they lie.
class Neighbours {
 public:
  Neighbours(double radius, size_t most) : radius_(radius), heads_(std::bit_ceil(most + 1), kNone) {
    points_.reserve(most);
  }
  void add(const Candidate& candidate) {
    uint32_t& head = heads_[slotOf(cellOf(candidate.position))];
    points_.push_back({&candidate, head});
    head = uint32_t(points_.size() - 1);
  }
  // Whether any of them lies nearer than the radius, and on the same side.
  bool near(const Candidate& candidate) const {
    const glm::i64vec3 cell = cellOf(candidate.position);
    for (int64_t z = -1; z <= 1; ++z)
      for (int64_t y = -1; y <= 1; ++y)
        for (int64_t x = -1; x <= 1; ++x)
          for (uint32_t i = heads_[slotOf(cell + glm::i64vec3(x, y, z))]; i != kNone; i = points_[i].next) {
            const Candidate& other = *points_[i].candidate;
            const glm::dvec3 apart = other.position - candidate.position;
            if (glm::dot(apart, apart) < radius_ * radius_ && glm::dot(other.normal, candidate.normal) > 0)
              return true;
          }
    return false;
  }

 private:
  static constexpr uint32_t kNone = ~0u;
  struct Point {
    const Candidate* candidate;
    uint32_t next;
  };
  glm::i64vec3 cellOf(const glm::dvec3& p) const { return glm::i64vec3(glm::floor(p / radius_)); }
  size_t slotOf(const glm::i64vec3& cell) const {
    return mixed(uint64_t(cell.x) * 73856093u ^ uint64_t(cell.y) * 19349663u ^ uint64_t(cell.z) * 83492791u) &
           (heads_.size() - 1);
  }
  double radius_;
  std::vector<uint32_t> heads_;  // by slot
  std::vector<Point> points_;
};

}  // namespace

double areaOf(const Primitive& primitive) {
  double area = 0;
  for (size_t t = 0; t < primitive.indices.size() / 3; ++t)
    area += 0.5 * glm::length(outwardOf(primitive, t));
  return area;
}

std::vector<SurfaceAnchor> anchorsOf(const Primitive& primitive, uint32_t candidates, uint32_t seed) {
  const size_t triangles = primitive.indices.size() / 3;
  std::vector<double> upTo(triangles);  // area of all triangles up to one
  double area = 0;
  for (size_t t = 0; t < triangles; ++t) upTo[t] = area += 0.5 * glm::length(outwardOf(primitive, t));
  if (!(area > 0) || !std::isfinite(area) || candidates == 0) return {};

  // Candidates go on for ever, and those up to any one are spread evenly by area: steps of the golden ratio.
  const uint64_t own = mixed(seed);
  const double begin = Numbers(own).next();
  const auto candidateOf = [&](uint64_t i) {
    Numbers numbers(mixed(own ^ i));
    const double at = area * std::fmod(begin + double(i) * 0.6180339887498949, 1.0);
    const size_t t =
        std::min(size_t(std::upper_bound(upTo.begin(), upTo.end(), at) - upTo.begin()), triangles - 1);
    double u = numbers.next(), v = numbers.next();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    Candidate c;
    const uint32_t* const corners = &primitive.indices[3 * t];
    c.anchor = {corners[0], corners[1], corners[2], float(u), float(v), 0, 0, uint32_t(numbers.bits())};
    const glm::dvec3 a(primitive.positions[corners[0]]), b(primitive.positions[corners[1]]),
        d(primitive.positions[corners[2]]);
    c.position = a + u * (b - a) + v * (d - a);
    const glm::dvec3 outward = outwardOf(primitive, t);
    const double size = glm::length(outward);
    c.anchor.area = float(0.5 * size);
    c.normal = size > 0 ? outward / size : glm::dvec3(0, 0, 1);
    return c;
  };

  // Level by level: of so many candidates for each place all that are far enough from those that are there
  // already. How many there are of finer levels changes nothing in a coarser one.
  std::vector<Candidate> all;
  all.reserve(candidates);
  std::vector<SurfaceAnchor> anchors;
  std::vector<bool> isTaken(candidates, false);
  std::vector<uint32_t> taken;
  double wider = std::sqrt(area) * 2;
  for (double spacing = std::sqrt(area);; wider = spacing, spacing *= 0.70710678) {
    const double places = area / (spacing * spacing);
    const auto count = uint64_t(std::ceil(kCandidatesForPlace * places));
    if (count > candidates) break;
    while (all.size() < count) all.push_back(candidateOf(all.size()));
    // About so many fit, and some more.
    Neighbours neighbours(spacing, std::min<size_t>(count, 64 + size_t(2 * places)));
    for (const uint32_t i : taken) neighbours.add(all[i]);
    const size_t first = taken.size();
    for (uint32_t i = 0; i < count; ++i) {
      if (isTaken[i] || neighbours.near(all[i])) continue;
      isTaken[i] = true;
      taken.push_back(i);
      neighbours.add(all[i]);
    }
    // Between two levels spacings go on evenly.
    for (size_t i = first; i < taken.size(); ++i) {
      SurfaceAnchor anchor = all[taken[i]].anchor;
      anchor.spacing =
          float(wider * std::pow(spacing / wider, (i - first + 0.5) / double(taken.size() - first)));
      anchors.push_back(anchor);
    }
  }
  return anchors;
}

}  // namespace scumble::scene
