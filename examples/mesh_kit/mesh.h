// Plain triangle meshes as the generators make them and as the GLB writer writes them.
// Conventions are glTF's: right-handed, +Y up, metres.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace meshkit {

struct Vertex {
  glm::vec3 position, normal;
  glm::vec2 uv;
};

// Triangles that share one material.
struct Primitive {
  int material = 0;
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;

  size_t triangleCount() const {
    size_t count = 0;
    for (const Primitive& p : primitives) count += p.indices.size() / 3;
    return count;
  }
};

}  // namespace meshkit
