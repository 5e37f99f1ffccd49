// Finds vertices that share a position: to the bit, or on a grid.
#pragma once

#include <bit>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/scene_data.h"

namespace scumble::scene {

// Positions on a grid of 1 / 65536 of the extent: the two sides of a seam are often computed, and differ by a
// rounding. Round numbers lie in the middle of a cell.
class PositionGrid {
 public:
  explicit PositionGrid(float inverseExtent) : scale_(65536.0f * inverseExtent) {}
  glm::vec3 operator()(const glm::vec3& p) const { return glm::round(p * scale_); }

 private:
  float scale_;
};

// An open-addressing hash table of positions; values are the caller's vertex numbers.
class PositionTable {
 public:
  explicit PositionTable(size_t capacity)
      : mask_(std::bit_ceil(capacity * 2 + 2) - 1), slots_(mask_ + 1, kEmpty) {}

  // The number that was stored first for this position, or `number`, which is then stored. `positionOf` maps
  // a stored number to its position.
  template <class PositionOf>
  uint32_t findOrAdd(const glm::vec3& position, uint32_t number, const PositionOf& positionOf) {
    return findOrAddIf(position, 0, number, [&](uint32_t stored) { return positionOf(stored) == position; });
  }

  // The same where more than the position tells vertices apart: `isSame` of a stored number. `more`:
  // something that is equal where they are the same, so that thousands at one position need not all be
  // compared.
  template <class IsSame>
  uint32_t findOrAddIf(const glm::vec3& position, uint64_t more, uint32_t number, const IsSame& isSame) {
    for (size_t slot = hash(position, more) & mask_;; slot = (slot + 1) & mask_) {
      if (slots_[slot] == kEmpty) {
        slots_[slot] = number;
        return number;
      }
      if (isSame(slots_[slot])) return slots_[slot];
    }
  }

 private:
  static constexpr uint32_t kEmpty = 0xffffffffu;

  static size_t hash(const glm::vec3& p, uint64_t more) {
    // Adding zero turns -0 into +0, which compares equal.
    const uint64_t x = std::bit_cast<uint32_t>(p.x + 0.0f), y = std::bit_cast<uint32_t>(p.y + 0.0f),
                   z = std::bit_cast<uint32_t>(p.z + 0.0f);
    uint64_t h = (x << 32 | y) * 0x9e3779b97f4a7c15ull;
    h = (h ^ (h >> 29) ^ z) * 0xbf58476d1ce4e5b9ull;
    h = (h ^ (h >> 32) ^ more) * 0x94d049bb133111ebull;
    return static_cast<size_t>(h ^ (h >> 32));
  }

  size_t mask_;
  std::vector<uint32_t> slots_;
};

// Of meshes that lie in one space.
PositionGrid gridOf(std::span<const Primitive* const> primitives);

// By vertex, the first one at its place on the grid.
inline std::vector<uint32_t> firstAtPlaces(const std::vector<glm::vec3>& positions,
                                           const PositionGrid& grid) {
  PositionTable table(positions.size());
  std::vector<uint32_t> first(positions.size());
  for (uint32_t v = 0; v < first.size(); ++v)
    first[v] =
        table.findOrAdd(grid(positions[v]), v, [&](uint32_t stored) { return grid(positions[stored]); });
  return first;
}

}  // namespace scumble::scene
