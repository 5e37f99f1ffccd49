// The images and buffers of a frame graph, in memory that those share which live at different times of a
// frame, and no longer.
#pragma once

#include <vector>

#include "gpu/frame_graph.h"

namespace scumble::gpu {

// Something that needs memory from one step to another, both included.
struct Lodger {
  uint64_t bytes = 0, alignment = 1;  // alignment: a power of two
  size_t first = 0, last = 0;

  bool meets(const Lodger& other) const { return first <= other.last && other.first <= last; }
};
struct Lodging {
  std::vector<uint64_t> offsets;  // by lodger
  uint64_t bytes = 0;             // of all of them together
};
// Those who meet do not overlap: the largest first, each as low as it can lie.
Lodging lodge(std::span<const Lodger> lodgers);

class GraphResources {
 public:
  GraphResources(Device& device, const FrameGraph& graph, const FrameGraph::Needs& needs,
                 const ImageShape::Frame& frame);
  ~GraphResources();
  GraphResources(const GraphResources&) = delete;
  GraphResources& operator=(const GraphResources&) = delete;

  // Makes all for another size of the frame, so that nothing is left in kept images; nothing may be under
  // way.
  void resize(const ImageShape::Frame& frame);
  // The image that stands for one which was imported, until the next one does.
  void import(Handle handle, const Image* image) { imported_[handle.resource] = image; }

  // Of what is needed; what is not has no image, and no buffer.
  const Image& image(Handle handle) const { return *imageOf(handle.resource); }
  const Image* imageOf(uint32_t resource) const {
    if (imported_[resource]) return imported_[resource];
    return images_[resource].handle() ? &images_[resource] : nullptr;
  }
  VkBuffer buffer(Handle handle) const { return buffers_[handle.resource].handle(); }
  // Barriers before each step, and after all, for these very resources.
  const std::vector<std::vector<Barrier>>& barriers() const { return barriers_; }
  // Bytes that the images take, and that they would take without sharing.
  uint64_t bytes() const { return bytes_; }
  uint64_t bytesUnshared() const { return bytesUnshared_; }

 private:
  void release();
  void beginKept();

  Device& device_;
  const FrameGraph& graph_;
  const FrameGraph::Needs& needs_;
  std::vector<Image> images_;           // by resource
  std::vector<const Image*> imported_;  // by resource
  std::vector<Buffer> buffers_;         // by resource
  std::vector<Allocation> memory_;
  std::vector<std::vector<Barrier>> barriers_;
  uint64_t bytes_ = 0, bytesUnshared_ = 0;
};

}  // namespace scumble::gpu
