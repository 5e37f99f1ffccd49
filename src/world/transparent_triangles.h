// The triangles of blended surfaces, of all objects: one order over all of them, the farthest first, serves
// both eyes (passes/order finds it).
#pragma once

#include <functional>
#include <map>

#include "gpu/frames_in_flight.h"
#include "scene/scene_data.h"
#include "shading/transparent.shared.h"
#include "stage/viewers.h"

namespace scumble::world {

using namespace stage;

class TransparentTriangles {
 public:
  struct Part {
    const scene::Primitive* primitive;
    uint32_t object, firstVertex;  // of the final ones
    uint32_t material;
    bool varied;
    float fadeStart;  // of a fin, else 0
    bool isCoat;      // paint that is not seen from behind
    bool operator==(const Part&) const = default;
  };
  // All that there is. Primitives that are the same objects as before have the same triangles. Where there
  // are others the buffers have other names, which is told by true, and `settle` is called before they go.
  bool update(gpu::Device& device, std::vector<Part> parts, const std::function<void()>& settle);

  // For the next frame: where objects are, and whether they are mirrored, both by object.
  void look(const Viewers& viewers, const std::vector<scene::Bounds>& bounds,
            const std::vector<uint8_t>& mirrored);

  uint32_t count() const { return count_; }
  bool isVisible() const { return isVisible_; }  // any of them
  // Materials that there are, each with how far the farthest of it is that is seen, metres.
  const std::map<uint32_t, float>& farthest() const { return farthest_; }
  uint64_t bytes() const {
    return triangles_.size() + partOfVertex_.size() + indices_.size() + parts_.size();
  }
  // shared::TransparentTriangle, and shared::TransparentPart.
  VkBuffer triangles() const { return triangles_.handle(); }
  VkBuffer parts() const { return parts_.handle(); }
  // A 32-bit number of a part for each final vertex, up to the last one that is a part's.
  VkBuffer partOfVertex() const { return partOfVertex_.handle(); }
  // Three final vertices for each triangle, in the frame's order.
  VkBuffer indices() const { return indices_.handle(); }
  void addUploads(std::vector<gpu::PerFrameBuffer*>& uploads) {
    if (count_ > 0) uploads.push_back(&parts_);
  }

 private:
  std::vector<Part> known_;
  uint32_t count_ = 0;
  bool isVisible_ = false;
  std::map<uint32_t, float> farthest_;
  gpu::Buffer triangles_, partOfVertex_, indices_;
  gpu::PerFrameBuffer parts_;
};

}  // namespace scumble::world
