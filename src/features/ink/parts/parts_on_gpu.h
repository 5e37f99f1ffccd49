// Which piece of which mesh each final vertex is of, in device memory.
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "gpu/resources.h"
#include "scene/scene_data.h"
#include "world/geometry_on_gpu.h"

namespace scumble::ink {

class PartsOnGpu {
 public:
  // As EdgesOnGpu: pieces of meshes that are new, while their vertices are there; then the buffer, true where
  // it is another one.
  void find(const std::vector<world::GeometryItem>& items);
  bool update(gpu::Device& device, gpu::Uploader& uploader, const std::vector<world::GeometryItem>& items,
              const std::vector<world::GeometryOnGpu::Place>& places, const std::function<void()>& settle);
  // A number for each final vertex; no two meshes share one. Below kMostParts.
  const gpu::Buffer& parts() const { return parts_; }
  static constexpr uint32_t kOfNoMesh = 1;  // the ground, the sea and what floats on it: they have no lines
  static constexpr uint32_t kMostParts = 1u << 24;  // whole numbers that a float can have

 private:
  using Mesh = std::vector<const scene::Primitive*>;
  std::map<Mesh, std::vector<std::vector<uint32_t>>> partsOf_;  // by primitive and vertex
  struct Known {
    const scene::Primitive* primitive;
    uint32_t firstVertex;
    bool operator==(const Known&) const = default;
  };
  std::vector<Known> known_;  // what the buffer was written for
  gpu::Buffer parts_;
};

}  // namespace scumble::ink
