// The surface around which a painting lies, as fins and coats need it: welded, with what lies across each
// edge, and every triangle flat in the plane of a chart.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "scene/scene_data.h"

namespace scumble::bake {

// A vector of length 1; what has hardly any becomes `otherwise`.
inline glm::vec3 unitOr(const glm::vec3& otherwise, const glm::vec3& v) {
  const float length = glm::length(v);
  return length > 1e-20f ? v / length : otherwise;
}

// A turn and a shift of the plane. Points of it are complex numbers.
struct FlatMove {
  glm::vec2 turn{1, 0}, shift{0};
  glm::vec2 turned(const glm::vec2& v) const {
    return {turn.x * v.x - turn.y * v.y, turn.y * v.x + turn.x * v.y};
  }
  glm::vec2 operator()(const glm::vec2& p) const { return turned(p) + shift; }
};

struct ProxyTriangle {
  uint32_t primitive = 0;
  glm::uvec3 vertices{0u};                // of the primitive
  glm::uvec3 places{0u};                  // of the proxy
  std::array<int, 3> across{-1, -1, -1};  // the triangle beyond the edge from corner i to i + 1; -1: none
  std::array<FlatMove, 3> into;           // from this one's plane into that one's
  std::array<glm::vec2, 3> flat;          // corners in its chart's plane; counter-clockwise from outside
  glm::vec3 axisX{1, 0, 0}, axisY{0, 1, 0}, normal{0, 0, 1};  // that plane in space, unit length
  glm::vec2 field{1, 0};  // a direction in it that goes on over edges as far as that can be
  uint32_t chart = 0;
};

// A triangle, or two that are nearly a flat rectangle.
struct Chart {
  std::array<int, 2> triangles{-1, -1};
  glm::vec2 low{0}, high{0};  // its box in the plane
};

struct ProxyEdge {
  uint32_t a = 0, b = 0;  // places, as the first triangle goes
  std::array<int, 2> triangles{-1, -1};
  bool isDiagonal = false;  // within a chart
};

struct Proxy {
  std::vector<const scene::Primitive*> primitives;
  std::vector<glm::vec3> places, normals;    // welded vertices; normals have unit length
  std::vector<ProxyTriangle> triangles;      // but for those without area
  std::vector<std::vector<int>> triangleOf;  // by primitive and by its triangles; -1: it has no area
  std::vector<Chart> charts;
  std::vector<ProxyEdge> edges;
  std::vector<std::vector<uint32_t>> trianglesAt, edgesAt;  // by place
};

// Of primitives in one space, which stay as long as it does. Edges at which more than two triangles meet, or
// two that are wound against each other, end there.
Proxy makeProxy(const scene::Mesh& mesh);

}  // namespace scumble::bake
