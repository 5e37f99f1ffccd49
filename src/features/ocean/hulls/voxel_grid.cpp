#include "features/ocean/hulls/voxel_grid.h"

#include <algorithm>
#include <cmath>

namespace scumble::ocean {

namespace {

// Cubes that triangles' boxes may have in sum, and pairs of a triangle and a cube that it touches: what a
// hostile file can cost at most, about a second.
constexpr int64_t kMostTests = int64_t(1) << 26, kMostPairs = int64_t(1) << 23;

// Whether a triangle touches a cube, by the separating axes (Akenine-Moeller 2001). `half`: of its side.
bool touches(const Triangle& triangle, const glm::vec3& middle, float half) {
  const glm::vec3 corners[] = {triangle.a - middle, triangle.b - middle, triangle.c - middle};
  const auto isApart = [&](const glm::vec3& axis) {
    const float reach = half * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
    const float p = glm::dot(axis, corners[0]), q = glm::dot(axis, corners[1]),
                r = glm::dot(axis, corners[2]);
    return std::min({p, q, r}) > reach || std::max({p, q, r}) < -reach;
  };
  const glm::vec3 edges[] = {corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]};
  for (int i = 0; i < 3; ++i) {
    glm::vec3 axis(0.0f);
    axis[i] = 1.0f;
    if (isApart(axis)) return false;
    for (const glm::vec3& edge : edges)
      if (isApart(glm::cross(axis, edge))) return false;
  }
  return !isApart(glm::cross(edges[0], edges[1]));
}

// To a triangle (Ericson, Real-Time Collision Detection, 5.1.5).
float distanceTo(const Triangle& t, const glm::vec3& p) {
  const glm::vec3 ab = t.b - t.a, ac = t.c - t.a, ap = p - t.a, bp = p - t.b, cp = p - t.c;
  const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap), d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp),
              d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  const float va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (d1 <= 0 && d2 <= 0) return glm::length(ap);
  if (d3 >= 0 && d4 <= d3) return glm::length(bp);
  if (d6 >= 0 && d5 <= d6) return glm::length(cp);
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return glm::length(ap - d1 / (d1 - d3) * ab);
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return glm::length(ap - d2 / (d2 - d6) * ac);
  if (va <= 0 && d4 >= d3 && d5 >= d6)
    return glm::length(bp - (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (t.c - t.b));
  const float sum = va + vb + vc;
  return glm::length(ap - vb / sum * ab - vc / sum * ac);
}

// Whether a segment goes through a triangle.
bool crosses(const Triangle& t, const glm::vec3& from, const glm::vec3& to) {
  const glm::vec3 way = to - from, ab = t.b - t.a, ac = t.c - t.a;
  const glm::vec3 p = glm::cross(way, ac);
  const float det = glm::dot(ab, p);
  if (std::abs(det) < 1e-20f) return false;
  const glm::vec3 s = from - t.a, q = glm::cross(s, ab);
  const float u = glm::dot(s, p) / det, v = glm::dot(way, q) / det, along = glm::dot(ac, q) / det;
  constexpr float kEdge = 1e-4f;  // between two triangles nothing slips through
  return u >= -kEdge && v >= -kEdge && u + v <= 1 + kEdge && along >= 0 && along <= 1;
}

}  // namespace

VoxelGrid::VoxelGrid(const glm::vec3& least, const glm::vec3& most, int budget, int margin) {
  const glm::vec3 extent = most - least;
  const auto sizeFor = [&](float cell) {
    return glm::ivec3(glm::ceil(extent / cell)) + glm::ivec3(2 * margin + 1);
  };
  const auto countFor = [&](float cell) {
    const glm::dvec3 size(sizeFor(cell));
    return size.x * size.y * size.z;
  };
  // Finer step by step, from what is surely coarse enough.
  const float longest = std::max({extent.x, extent.y, extent.z});
  cell_ = longest;
  while (cell_ > longest / 1000 && countFor(cell_ * 0.96f) <= double(budget)) cell_ *= 0.96f;
  size_ = sizeFor(cell_);
  origin_ = 0.5f * (least + most) - 0.5f * cell_ * glm::vec3(size_ - 1);
}

bool VoxelGrid::add(std::span<const Triangle> triangles) {
  triangles_ = triangles;
  const auto rangeOf = [&](const Triangle& t) {
    const glm::vec3 low = (glm::min(t.a, glm::min(t.b, t.c)) - origin_) / cell_ - 0.501f,
                    high = (glm::max(t.a, glm::max(t.b, t.c)) - origin_) / cell_ + 0.501f;
    const glm::vec3 last(size_ - 1);
    return std::pair(glm::ivec3(glm::ceil(glm::clamp(low, glm::vec3(0), last + 1.0f))),
                     glm::ivec3(glm::floor(glm::clamp(high, glm::vec3(-1), last))));
  };
  int64_t tests = 0;
  for (const Triangle& triangle : triangles) {
    const auto [low, high] = rangeOf(triangle);
    const glm::i64vec3 span = glm::max(high - low + 1, glm::ivec3(0));
    tests += span.x * span.y * span.z;
  }
  if (tests > kMostTests) return false;

  std::vector<std::pair<uint32_t, uint32_t>> pairs;
  for (uint32_t i = 0; i < triangles.size(); ++i) {
    const auto [low, high] = rangeOf(triangles[i]);
    for (int y = low.y; y <= high.y; ++y)
      for (int z = low.z; z <= high.z; ++z)
        for (int x = low.x; x <= high.x; ++x)
          if (touches(triangles[i], middle({x, y, z}), 0.501f * cell_))
            pairs.emplace_back(uint32_t(index({x, y, z})), i);
    if (int64_t(pairs.size()) > kMostPairs) return false;
  }
  starts_.assign(count() + 1, 0);
  for (const auto& [voxel, triangle] : pairs) ++starts_[voxel + 1];
  for (size_t i = 0; i < count(); ++i) starts_[i + 1] += starts_[i];
  lists_.resize(pairs.size());
  std::vector<uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (const auto& [voxel, triangle] : pairs) lists_[next[voxel]++] = triangle;
  return true;
}

bool VoxelGrid::isBetween(const glm::ivec3& a, const glm::ivec3& b) const {
  const glm::vec3 from = middle(a), to = middle(b);
  // A segment along a diagonal goes through other cubes as well.
  const glm::ivec3 low = glm::min(a, b), high = glm::max(a, b);
  for (int y = low.y; y <= high.y; ++y)
    for (int z = low.z; z <= high.z; ++z)
      for (int x = low.x; x <= high.x; ++x)
        for (const uint32_t triangle : touching(index({x, y, z})))
          if (crosses(triangles_[triangle], from, to)) return true;
  return false;
}

std::optional<float> VoxelGrid::distance(const glm::ivec3& at) const {
  std::optional<float> least;
  const glm::vec3 from = middle(at);
  const glm::ivec3 low = glm::max(at - 1, glm::ivec3(0)), high = glm::min(at + 1, size_ - 1);
  for (int y = low.y; y <= high.y; ++y)
    for (int z = low.z; z <= high.z; ++z)
      for (int x = low.x; x <= high.x; ++x)
        for (const uint32_t triangle : touching(index({x, y, z}))) {
          const float there = distanceTo(triangles_[triangle], from);
          if (!least || there < *least) least = there;
        }
  return least;
}

}  // namespace scumble::ocean
