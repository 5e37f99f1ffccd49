// The edges of all that is drawn, in device memory.
// What instances share is there once.
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "features/ink/edge_bounds.shared.h"
#include "features/ink/edges.shared.h"
#include "gpu/resources.h"
#include "scene/mesh_edges.h"
#include "world/geometry_on_gpu.h"

namespace scumble::ink {

using namespace world;

class EdgesOnGpu {
 public:
  // Finds the edges of primitives that are new, while their vertices are there. Primitives that are the same
  // objects as before have the same edges; which parts of them are seen follows from the scene's materials.
  void find(const scene::SceneData& scene, const std::vector<GeometryItem>& items);
  // Brings the buffers up to date with what was found, and with where vertices are. True where they are
  // others; `settle` is called before the old ones go. Throws gpu::VulkanError where there are more than the
  // device binds at once.
  bool update(gpu::Device& device, gpu::Uploader& uploader, const std::vector<GeometryItem>& items,
              const std::vector<GeometryOnGpu::Place>& places, const std::function<void()>& settle);
  // How many runs of kEdgeChunk edges there are.
  uint32_t chunkCount() const { return chunkCount_; }
  uint64_t edgeCount() const { return edgeCount_; }
  // shared::DrawnEdge, shared::EdgeRing of the same ones, and shared::EdgeChunk.
  const gpu::Buffer& edges() const { return edges_; }
  const gpu::Buffer& rings() const { return rings_; }
  const gpu::Buffer& chunks() const { return chunks_; }
  // shared::EdgeBounds of words of edges.
  const gpu::Buffer& bounds() const { return bounds_; }

 private:
  struct Found {
    std::vector<scene::MeshEdge> edges;
    std::vector<uint32_t> ends;  // as shared::EdgeRing has them; empty or one an edge
    std::vector<shared::EdgeBounds> bounds;
    std::vector<uint32_t> seen;  // as shared::EdgeRing has it; empty: all is
    // What that follows from.
    scene::Material material;
    std::shared_ptr<const scene::TextureImage> image;
    bool isSeenOf(const scene::Material& other,
                  const std::shared_ptr<const scene::TextureImage>& otherImage) const;
  };
  void findSeen(const scene::SceneData& scene, const scene::Primitive& primitive, Found& found);

  std::map<const scene::Primitive*, Found> edgesOf_;
  std::map<std::vector<const scene::Primitive*>, std::vector<scene::SharedEdge>> sharedBy_;
  struct Known {
    const scene::Primitive* primitive;
    uint32_t firstVertex, firstRest;
    bool shown;
    bool operator==(const Known&) const = default;
  };
  std::vector<Known> known_;  // what the buffers were written for
  bool isSeenOtherwise_ = false;
  uint32_t chunkCount_ = 0;
  uint64_t edgeCount_ = 0;
  gpu::Buffer edges_, rings_, chunks_, bounds_;
};

}  // namespace scumble::ink
