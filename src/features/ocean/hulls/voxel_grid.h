// A grid of cubes, and which of a mesh's triangles touch which of them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace scumble::ocean {

struct Triangle {
  glm::vec3 a, b, c;
};

class VoxelGrid {
 public:
  // Cubes of one size that fill a box, which grows by some of them on all sides. As many as fit into
  // `budget`.
  VoxelGrid(const glm::vec3& least, const glm::vec3& most, int budget, int margin);

  // Whether that could be found out within a bounded time.
  bool add(std::span<const Triangle> triangles);

  const glm::ivec3& size() const { return size_; }
  size_t count() const { return size_t(size_.x) * size_t(size_.y) * size_t(size_.z); }
  float cell() const { return cell_; }
  const glm::vec3& origin() const { return origin_; }  // the first one's middle
  size_t index(const glm::ivec3& at) const {
    return (size_t(at.y) * size_t(size_.z) + size_t(at.z)) * size_t(size_.x) + size_t(at.x);
  }
  glm::ivec3 at(size_t index) const {
    const int x = int(index % size_t(size_.x)), rest = int(index / size_t(size_.x));
    return {x, rest / size_.z, rest % size_.z};
  }
  bool contains(const glm::ivec3& at) const {
    return at.x >= 0 && at.y >= 0 && at.z >= 0 && at.x < size_.x && at.y < size_.y && at.z < size_.z;
  }
  bool isBorder(const glm::ivec3& at) const {
    return !contains(at - glm::ivec3(1)) || !contains(at + glm::ivec3(1));
  }
  glm::vec3 middle(const glm::ivec3& at) const { return origin_ + cell_ * glm::vec3(at); }

  bool isTouched(size_t voxel) const { return starts_[voxel] != starts_[voxel + 1]; }
  // Whether a triangle lies between the middles of two neighbours.
  bool isBetween(const glm::ivec3& a, const glm::ivec3& b) const;
  // To the nearest triangle of those that touch the cubes around it, metres; none: none does.
  std::optional<float> distance(const glm::ivec3& at) const;

 private:
  std::span<const uint32_t> touching(size_t voxel) const {
    return std::span(lists_).subspan(starts_[voxel], starts_[voxel + 1] - starts_[voxel]);
  }

  glm::ivec3 size_;
  float cell_;
  glm::vec3 origin_;
  std::span<const Triangle> triangles_;
  std::vector<uint32_t> starts_, lists_;
};

}  // namespace scumble::ocean
