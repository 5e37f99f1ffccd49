// Plain triangle meshes as the generators make them and as the GLB writer writes them.
// Conventions are glTF's: right-handed, +Y up, metres.
#pragma once

#include <cassert>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace meshkit {

// Which joints of a skin a vertex follows, and how much; weights sum up to 1.
struct Binding {
  glm::u16vec4 joints{0};
  glm::vec4 weights{0.0f};
};

inline Binding boundTo(int joint) {
  return {{uint16_t(joint), 0, 0, 0}, {1.0f, 0.0f, 0.0f, 0.0f}};
}

// `t` of the way from one joint to the other. glTF wants joints without weight to be 0.
inline Binding boundBetween(int from, int to, float t) {
  if (t <= 0.0f) return boundTo(from);
  if (t >= 1.0f) return boundTo(to);
  return {{uint16_t(from), uint16_t(to), 0, 0}, {1.0f - t, t, 0.0f, 0.0f}};
}

struct Vertex {
  glm::vec3 position, normal;
  glm::vec2 uv;
  Binding binding{};
};

// What a morph target adds to a vertex.
struct VertexChange {
  glm::vec3 position, normal;
};

// Triangles that share one material.
struct Primitive {
  int material = 0;
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;
  std::vector<std::vector<VertexChange>> targets{};  // each as long as `vertices`
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
  bool bound = false;            // its vertices follow joints
  std::vector<float> weights{};  // of the morph targets, at rest

  size_t triangleCount() const {
    size_t count = 0;
    for (const Primitive& p : primitives) count += p.indices.size() / 3;
    return count;
  }

  // A morph target that turns this mesh into another one that was built in the same way.
  void addTarget(const Mesh& moved) {
    weights.push_back(0.0f);
    for (size_t p = 0; p < primitives.size(); ++p) {
      const std::vector<Vertex>&from = primitives[p].vertices, &to = moved.primitives[p].vertices;
      assert(from.size() == to.size());
      std::vector<VertexChange> changes;
      for (size_t i = 0; i < from.size(); ++i)
        changes.push_back({to[i].position - from[i].position, to[i].normal - from[i].normal});
      primitives[p].targets.push_back(std::move(changes));
    }
  }
};

}  // namespace meshkit
