// The place on a surface that is nearest to a point.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "scene/scene_data.h"

namespace scumble::scene {

// Of primitives in one space, whose vertices must be there, and stay as long as this does. Several threads
// may ask.
class NearestPlaces {
 public:
  explicit NearestPlaces(std::span<const Primitive* const> primitives);
  ~NearestPlaces();
  NearestPlaces(const NearestPlaces&) = delete;
  NearestPlaces& operator=(const NearestPlaces&) = delete;

  // Whether there is no triangle with an area: nothing is near then.
  bool isEmpty() const { return triangles_.empty(); }

  struct Place {
    uint32_t primitive = 0;   // which one of those given
    uint32_t triangle = 0;    // of it
    glm::uvec3 vertices{0u};  // of it: a triangle
    glm::vec2 at{0.0f};       // the second and the third corner's part
    // What a triangle's corners mix to.
    template <class Values>
    auto mixed(const Values& of) const {
      return (1 - at.x - at.y) * of[vertices.x] + at.x * of[vertices.y] + at.y * of[vertices.z];
    }
  };
  Place to(const glm::vec3& point) const;

 private:
  struct Triangle {
    uint32_t primitive, number;
    glm::uvec3 vertices;
  };
  struct Tree;  // Embree's, so that its headers stay where they are
  const glm::vec3& corner(const Triangle& t, int i) const {
    return primitives_[t.primitive]->positions[t.vertices[i]];
  }

  std::vector<const Primitive*> primitives_;
  std::vector<Triangle> triangles_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace scumble::scene
