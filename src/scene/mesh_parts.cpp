#include "scene/mesh_parts.h"

#include <utility>

#include "scene/position_weld.h"

namespace scumble::scene {

namespace {

// Sets that are joined, each known by its first member.
class Joined {
 public:
  explicit Joined(std::vector<uint32_t> first) : above_(std::move(first)) {}
  uint32_t firstOf(uint32_t member) {
    while (above_[member] != member) member = above_[member] = above_[above_[member]];
    return member;
  }
  void join(uint32_t a, uint32_t b) {
    a = firstOf(a), b = firstOf(b);
    above_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<uint32_t> above_;
};

}  // namespace

std::vector<std::vector<uint32_t>> partsOf(std::span<const Primitive* const> primitives) {
  std::vector<glm::vec3> places;
  for (const Primitive* primitive : primitives)
    places.insert(places.end(), primitive->positions.begin(), primitive->positions.end());
  Joined pieces(firstAtPlaces(places, gridOf(primitives)));
  uint32_t first = 0;
  for (const Primitive* primitive : primitives) {
    const std::vector<uint32_t>& corners = primitive->indices;
    for (size_t c = 0; c + 2 < corners.size(); c += 3) {
      pieces.join(first + corners[c], first + corners[c + 1]);
      pieces.join(first + corners[c], first + corners[c + 2]);
    }
    first += uint32_t(primitive->positions.size());
  }

  std::vector<std::vector<uint32_t>> parts;
  std::vector<uint32_t> number(places.size());  // of those that are a piece's first
  uint32_t count = 0, vertex = 0;
  for (const Primitive* primitive : primitives) {
    std::vector<uint32_t>& part = parts.emplace_back(primitive->positions.size());
    for (uint32_t& p : part) {
      const uint32_t piece = pieces.firstOf(vertex);
      if (piece == vertex) number[vertex] = count++;
      p = number[piece];
      ++vertex;
    }
  }
  return parts;
}

}  // namespace scumble::scene
