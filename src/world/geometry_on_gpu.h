// The vertices of a scene's geometry in device memory: at rest, once for each primitive, and as `deform`
// writes them for a frame, once for each item that is drawn.
#pragma once

#include <functional>
#include <vector>

#include "gpu/resources.h"
#include "world/geometry.h"

namespace scumble::world {

// A part of the vertices at rest and one of the final ones, as much as the device binds at a time: `deform`
// goes from page to page. Chunks count their vertices from where their page begins.
struct VertexPage {
  uint32_t firstRest = 0, firstFinal = 0;  // vertices
  auto operator<=>(const VertexPage&) const = default;
};

// Where an item's data lies.
struct GeometryPlace {
  uint32_t firstIndex = 0, firstVertex = 0;  // in GeometryOnGpu::indices(), in the final vertices
  uint32_t firstRest = 0;                    // in those at rest, which items of one primitive share
  uint32_t firstChunk = 0, chunkCount = 0;   // in GeometryOnGpu::chunks()
  bool morphs = false;
};

// How many final vertices there are up to the last of these items.
uint64_t finalVertexCount(const std::vector<GeometryItem>& items, const std::vector<GeometryPlace>& places);

class GeometryOnGpu {
 public:
  using Place = GeometryPlace;
  // Brings the buffers up to date. Primitives that are the same objects as before are taken to have the same
  // vertices; those of before must still be alive. True where all buffers are others; else those that are new
  // were written in place. Calls `settle` before it changes anything that frames under way read, and ends
  // with uploads that are not flushed. Throws gpu::VulkanError when it does not fit.
  bool update(gpu::Device& device, gpu::Uploader& uploader, const std::vector<GeometryItem>& items,
              const std::function<void()>& settle);

  // By item.
  const std::vector<Place>& places() const { return places_; }
  // Items whose vertices at rest the last update() has written in place.
  const std::vector<uint32_t>& rewritten() const { return rewritten_; }
  uint32_t chunkCount() const { return uint32_t(pageOfChunk_.size()); }
  const std::vector<VertexPage>& pages() const { return pages_; }
  // By chunk: index of its page.
  const std::vector<uint32_t>& pageOfChunk() const { return pageOfChunk_; }
  // How many vertices of any kind a page has at most.
  uint32_t pageVertices() const { return pageVertices_; }
  uint32_t vertexCount() const { return vertexCount_; }  // final ones, at least one
  // How many primitives the last update() has written.
  uint32_t written() const { return written_; }
  uint64_t bytes() const { return bytes_; }

  const gpu::Buffer& chunks() const { return chunks_; }
  const gpu::Buffer& restCore() const { return restCore_; }
  const gpu::Buffer& restFrame() const { return restFrame_; }
  const gpu::Buffer& restSkin() const { return restSkin_; }
  const gpu::Buffer& morphStarts() const { return morphStarts_; }
  const gpu::Buffer& morphs() const { return morphs_; }
  const gpu::Buffer& finalCore() const { return finalCore_; }
  const gpu::Buffer& finalFrame() const { return finalFrame_; }
  // Where no vertex has its own, uv0 serves for the other two.
  const gpu::Buffer& uv0() const { return uv0_; }
  const gpu::Buffer& uv1() const { return plan_.streams.uv1 ? uv1_ : uv0_; }
  const gpu::Buffer& patternUv() const { return plan_.streams.patternUv ? patternUv_ : uv0_; }
  const gpu::Buffer& tint() const { return tint_; }
  // Bytes from one vertex's to the next one's; 0: all have the same.
  uint32_t tintStride() const { return plan_.streams.tint ? sizeof(shared::VertexTint) : 0; }
  const gpu::Buffer& indices() const { return indices_; }

 private:
  // A primitive's place in the rest buffers.
  struct Rest {
    const scene::Primitive* primitive;
    uint32_t vertex = 0, index = 0, skin = 0;
    uint32_t morph = shared::kNoMorph;  // first entry in the list of where displacements begin
    uint32_t vertexCount = 0, indexCount = 0;
    int influences = 0;
    bool drops = false;  // the primitive's own vertices
    bool isLaidAs(const Rest& other) const {
      return vertexCount == other.vertexCount && indexCount == other.indexCount &&
             influences == other.influences && morph == shared::kNoMorph && other.morph == shared::kNoMorph;
    }
  };
  // Those of which some vertices have their own.
  struct Streams {
    bool uv1 = false, patternUv = false, tint = false;
    bool holds(const Streams& other) const {
      return uv1 >= other.uv1 && patternUv >= other.patternUv && tint >= other.tint;
    }
  };
  struct Plan {
    Streams streams;
    std::vector<Rest> rests;        // of primitives, each once
    std::vector<uint32_t> restOf;   // by item
    std::vector<glm::vec2> shifts;  // of pattern coordinates, by item
  };
  static Plan planOf(const std::vector<GeometryItem>& items);
  void rewrite(gpu::Uploader& uploader, const Plan& plan, const std::function<void()>& settle);
  void build(gpu::Device& device, gpu::Uploader& uploader, Plan& plan);

  Plan plan_;
  std::vector<Place> places_;
  std::vector<uint32_t> rewritten_;
  std::vector<VertexPage> pages_;
  std::vector<uint32_t> pageOfChunk_;
  uint32_t pageVertices_ = 0, vertexCount_ = 0, written_ = 0;
  uint64_t bytes_ = 0;
  gpu::Buffer chunks_, restCore_, restFrame_, restSkin_, morphStarts_, morphs_, finalCore_, finalFrame_, uv0_,
      uv1_, patternUv_, tint_, indices_;
};

}  // namespace scumble::world
