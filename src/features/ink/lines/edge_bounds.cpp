#include "features/ink/lines/edge_bounds.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "features/ink/ink.shared.h"

namespace scumble::ink {

namespace {

shared::EdgeBounds boundsOf(const std::vector<glm::vec3>& positions, std::span<const scene::MeshEdge> edges) {
  shared::EdgeBounds bounds{};
  bounds.cosBend = 1;
  glm::vec3 low(INFINITY), high(-INFINITY), sum(0.0f);
  std::vector<glm::vec3> normals;
  const auto add = [&](const glm::vec3& normal) {
    const float length = glm::length(normal);
    if (!(length > 0)) return glm::vec3(0.0f);
    normals.push_back(normal / length);
    sum += normals.back();
    return normals.back();
  };
  for (const scene::MeshEdge& edge : edges) {
    const glm::vec3 a = positions[edge.a], b = positions[edge.b];
    for (const glm::vec3& end : {a, b}) low = glm::min(low, end), high = glm::max(high, end);
    const glm::vec3 left = add(glm::cross(b - a, positions[edge.left] - a));
    bounds.kinds |= edge.kinds << 28 & (shared::kEdgeMaterialBorder | shared::kEdgeColorBorder);
    if (edge.right == scene::MeshEdge::kNone) {
      bounds.kinds |= shared::kEdgeOpen;
      continue;
    }
    const glm::vec3 right = add(glm::cross(positions[edge.right] - a, b - a));
    bounds.cosBend = std::min(bounds.cosBend, glm::dot(left, right));
  }
  bounds.middle = 0.5f * (low + high);
  for (const scene::MeshEdge& edge : edges)
    for (const uint32_t end : {edge.a, edge.b})
      bounds.radius = std::max(bounds.radius, glm::distance(bounds.middle, positions[end]));
  bounds.cosAngle = glm::dot(sum, sum) > 0 ? 1.0f : -1.0f;
  if (bounds.cosAngle > 0) bounds.axis = glm::normalize(sum);
  for (const glm::vec3& normal : normals)
    bounds.cosAngle = std::min(bounds.cosAngle, glm::dot(normal, bounds.axis));
  bounds.sinAngle = std::sqrt(std::max(1 - bounds.cosAngle * bounds.cosAngle, 0.0f));
  return bounds;
}

constexpr size_t kWord = size_t(shared::kInkThreads);

// An edge as a place and a direction, in six numbers: ends' middle, in parts of the primitive's size, and
// normal.
struct PlacedNormal {
  float at[6];
  uint32_t edge;
};

// Halves what is more than a word at the middle of the number that differs most, so that no half but the last
// has a broken word.
void sortInPatches(std::span<PlacedNormal> edges) {
  const auto byEdge = [](const PlacedNormal& x, const PlacedNormal& y) { return x.edge < y.edge; };
  if (edges.size() <= kWord) {
    std::sort(edges.begin(), edges.end(), byEdge);
    return;
  }
  float low[6], high[6];
  std::fill(low, low + 6, INFINITY), std::fill(high, high + 6, -INFINITY);
  for (const PlacedNormal& edge : edges)
    for (int i = 0; i < 6; ++i)
      low[i] = std::min(low[i], edge.at[i]), high[i] = std::max(high[i], edge.at[i]);
  int widest = 0;
  for (int i = 1; i < 6; ++i)
    if (high[i] - low[i] > high[widest] - low[widest]) widest = i;
  const size_t words = (edges.size() + kWord - 1) / kWord, half = words / 2 * kWord;
  std::nth_element(edges.begin(), edges.begin() + std::ptrdiff_t(half), edges.end(),
                   [&](const PlacedNormal& x, const PlacedNormal& y) {
                     return x.at[widest] != y.at[widest] ? x.at[widest] < y.at[widest] : byEdge(x, y);
                   });
  sortInPatches(edges.first(half));
  sortInPatches(edges.subspan(half));
}

}  // namespace

std::vector<scene::MeshEdge> inPatches(const scene::Primitive& primitive,
                                       const std::vector<scene::MeshEdge>& edges) {
  const std::vector<glm::vec3>& positions = primitive.positions;
  glm::vec3 low(INFINITY), high(-INFINITY);
  for (const glm::vec3& position : positions) low = glm::min(low, position), high = glm::max(high, position);
  const glm::vec3 sides = high - low;
  const float scale = 1 / std::max({sides.x, sides.y, sides.z, 1e-30f});
  std::vector<PlacedNormal> placed(edges.size());
  for (uint32_t e = 0; e < edges.size(); ++e) {
    const glm::vec3 a = positions[edges[e].a], b = positions[edges[e].b];
    const glm::vec3 middle = scale * (0.5f * (a + b) - low);
    const glm::vec3 across = glm::cross(b - a, positions[edges[e].left] - a);
    const glm::vec3 normal = across / std::max(glm::length(across), 1e-37f);
    placed[e] = {{middle.x, middle.y, middle.z, normal.x, normal.y, normal.z}, e};
  }
  sortInPatches(placed);
  std::vector<scene::MeshEdge> sorted;
  sorted.reserve(edges.size());
  for (const PlacedNormal& edge : placed) sorted.push_back(edges[edge.edge]);
  return sorted;
}

std::vector<shared::EdgeBounds> boundsOf(const scene::Primitive& primitive,
                                         const std::vector<scene::MeshEdge>& edges) {
  if (primitive.influences > 0 || !primitive.morphTargets.empty()) return {};
  std::vector<shared::EdgeBounds> bounds;
  bounds.reserve((edges.size() + kWord - 1) / kWord);
  for (size_t first = 0; first < edges.size(); first += kWord)
    bounds.push_back(boundsOf(primitive.positions,
                              std::span(edges).subspan(first, std::min(kWord, edges.size() - first))));
  return bounds;
}

}  // namespace scumble::ink
