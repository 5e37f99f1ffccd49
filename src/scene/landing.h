// Where a point lies on triangles that are near it.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace scumble::scene {

// Triangles by corner.
class TrianglesByCorner {
 public:
  TrianglesByCorner(std::span<const uint32_t> triangles, size_t vertices);
  std::span<const uint32_t> operator[](uint32_t vertex) const {
    return {at_.data() + first_[vertex], first_[vertex + 1] - first_[vertex]};
  }

 private:
  std::vector<uint32_t> first_, at_;
};

struct Landing {
  uint32_t triangle = ~0u;
  glm::vec3 weights{0.0f};  // of its corners
  float distance = 0;       // of the point, in the positions' unit
};

// Goes from the triangles around a vertex to those that are nearest, over some that are no nearer.
class LandingSearch {
 public:
  static constexpr uint32_t kNone = ~0u;

  // Both spans have to outlive it.
  LandingSearch(std::span<const glm::vec3> positions, std::span<const uint32_t> triangles);

  // `start`: a vertex that a triangle has, near the point.
  Landing operator()(const glm::vec3& point, uint32_t start);

 private:
  struct Found : Landing {
    bool isPassed = false;
  };
  void lookAround(const glm::vec3& point, uint32_t vertex);

  std::span<const glm::vec3> positions_;
  std::span<const uint32_t> triangles_;
  TrianglesByCorner corners_;
  std::vector<uint32_t> seen_;  // by triangle: the last search that did
  uint32_t search_ = 0;
  std::vector<Found> found_;
  std::vector<uint32_t> vertices_;
};

}  // namespace scumble::scene
