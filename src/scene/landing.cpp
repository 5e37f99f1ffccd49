#include "scene/landing.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace scumble::scene {

namespace {

// Barycentric coordinates of the point of a triangle that is nearest to `p`.
glm::vec3 nearestOf(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& p) {
  const glm::vec3 ab = b - a, ac = c - a, ap = p - a;
  const float bb = glm::dot(ab, ab), bc = glm::dot(ab, ac), cc = glm::dot(ac, ac);
  const float pb = glm::dot(ap, ab), pc = glm::dot(ap, ac), area2 = bb * cc - bc * bc;
  // Of a point that is not over the triangle, the nearest one lies on an edge beyond which that is.
  bool isBeyond[3] = {true, true, true};
  if (area2 > 1e-12f * bb * cc) {
    const float v = (cc * pb - bc * pc) / area2, w = (bb * pc - bc * pb) / area2;
    if (v >= 0 && w >= 0 && v + w <= 1) return {1 - v - w, v, w};
    isBeyond[0] = w < 0;
    isBeyond[1] = v + w > 1;
    isBeyond[2] = v < 0;
  }
  const glm::vec3* const ends[] = {&a, &b, &c, &a};
  glm::vec3 nearest(1, 0, 0);
  float least = std::numeric_limits<float>::max();
  for (int edge = 0; edge < 3; ++edge) {
    if (!isBeyond[edge]) continue;
    const glm::vec3 along = *ends[edge + 1] - *ends[edge], off = p - *ends[edge];
    const float length2 = glm::dot(along, along);
    const float s = length2 > 0 ? std::clamp(glm::dot(off, along) / length2, 0.0f, 1.0f) : 0.0f;
    const glm::vec3 away = off - s * along;
    if (!(glm::dot(away, away) < least)) continue;
    least = glm::dot(away, away);
    nearest = glm::vec3(0.0f);
    nearest[edge] = 1 - s, nearest[(edge + 1) % 3] = s;
  }
  return nearest;
}

}  // namespace

TrianglesByCorner::TrianglesByCorner(std::span<const uint32_t> triangles, size_t vertices)
    : first_(vertices + 1, 0) {
  for (const uint32_t v : triangles) ++first_[v + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  at_.resize(triangles.size());
  std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
  for (size_t i = 0; i < triangles.size(); ++i) at_[next[triangles[i]]++] = uint32_t(i / 3);
}

LandingSearch::LandingSearch(std::span<const glm::vec3> positions, std::span<const uint32_t> triangles)
    : positions_(positions),
      triangles_(triangles),
      corners_(triangles, positions.size()),
      seen_(triangles.size() / 3, 0) {}

Landing LandingSearch::operator()(const glm::vec3& point, uint32_t start) {
  constexpr int kPatience = 3;  // triangles that bring nothing
  ++search_;
  found_.clear();
  lookAround(point, start);
  size_t nearest = 0;
  for (int patience = kPatience; patience > 0 && found_[nearest].distance > 0; --patience) {
    size_t next = found_.size();
    for (size_t i = 0; i < found_.size(); ++i)
      if (!found_[i].isPassed && (next == found_.size() || found_[i].distance < found_[next].distance))
        next = i;
    if (next == found_.size()) break;
    found_[next].isPassed = true;
    const float before = found_[nearest].distance;
    for (uint32_t k = 0; k < 3; ++k) lookAround(point, triangles_[3 * found_[next].triangle + k]);
    for (size_t i = 0; i < found_.size(); ++i)
      if (found_[i].distance < found_[nearest].distance) nearest = i;
    if (found_[nearest].distance < before) patience = kPatience + 1;
  }
  return found_[nearest];
}

void LandingSearch::lookAround(const glm::vec3& point, uint32_t vertex) {
  constexpr size_t kMost = 4096;  // triangles, of those that are nothing but a line
  vertices_.assign(1, vertex);
  for (size_t i = 0; i < vertices_.size(); ++i)
    for (const uint32_t t : corners_[vertices_[i]]) {
      if (seen_[t] == search_) continue;
      seen_[t] = search_;
      const uint32_t* at = &triangles_[3 * t];
      const glm::vec3 &a = positions_[at[0]], &b = positions_[at[1]], &c = positions_[at[2]];
      const glm::vec3 weights = nearestOf(a, b, c, point), ab = b - a, ac = c - a;
      found_.push_back({{t, weights, glm::length(weights.x * a + weights.y * b + weights.z * c - point)}});
      // Along a straight border they lie between this and those that have an area.
      const float bb = glm::dot(ab, ab), bc = glm::dot(ab, ac), cc = glm::dot(ac, ac);
      if (!(bb * cc - bc * bc > 1e-8f * bb * cc) && vertices_.size() < kMost)
        vertices_.insert(vertices_.end(), at, at + 3);
    }
}

}  // namespace scumble::scene
