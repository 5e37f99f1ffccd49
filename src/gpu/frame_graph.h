// The frame graph: which step reads and writes what, and from that which steps are needed, how long each
// image lives, and the barriers. Steps run in the order in which they were added; nothing is reordered. It
// plans only, and knows no device, so it is tested without one.
//
// Images and buffers are handles. A handle is one version of what it names: a step that writes makes the next
// version, and what nobody has asked for in the end is not drawn (as in Filament's FrameGraph). Sizes are
// relative to the frame's, so that a plan outlives a change of size (as in Granite's).
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gpu/resources.h"

namespace scumble::gpu {

// What a step does with a resource.
enum class Use : uint8_t {
  // Images.
  sampledByVertex,
  sampledByFragment,
  sampledByCompute,
  colorTarget,
  depthTarget,
  depthTest,              // read by the fixed test alone
  resolveTarget,          // of a multisampled colour target
  depthResolveTarget,     // of a multisampled depth target
  storageImageWrite,      // by compute
  storageImageReadWrite,  // by compute
  // Images and buffers.
  copySource,
  copyTarget,  // or cleared
  // Buffers.
  storageBufferRead,       // by compute
  storageBufferWrite,      // by compute
  storageBufferReadWrite,  // by compute
  storageBufferReadByVertex,
  storageBufferReadByFragment,
  uniformBufferByCompute,
  vertexBuffer,
  indexBuffer,
  indirectBuffer,
};

struct UseInfo {
  VkPipelineStageFlags2 stages;
  VkAccessFlags2 access;
  VkImageLayout layout;            // of images
  VkImageUsageFlags imageUsage;    // 0: no use of an image
  VkBufferUsageFlags bufferUsage;  // 0: no use of a buffer
  bool writes;
};
UseInfo useInfo(Use use);

// One version of an image or a buffer; version 0 is what is there before any step.
struct Handle {
  static constexpr uint32_t kNone = ~0u;
  uint32_t resource = kNone, version = 0;
  explicit operator bool() const { return resource != kNone; }
  bool operator==(const Handle&) const = default;
};

// The size and format of an image of a frame.
struct ImageShape {
  VkFormat format = VK_FORMAT_UNDEFINED;
  uint32_t overX = 1, overY = 1;   // the frame's size over these, rounded up
  uint32_t width = 0, height = 0;  // texels, where it has a size of its own
  bool perView = true;             // a layer a view; else one for all
  uint32_t samples = 1;

  struct Frame {
    uint32_t width, height, views;
  };
  ImageDesc at(const Frame& frame) const;
  bool operator==(const ImageShape&) const = default;
};

// How something that is not the graph's is used outside of a frame: `layout` counts for images alone.
struct Outside {
  VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 access = VK_ACCESS_2_NONE;
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;  // before: undefined discards what is there
};

// A memory dependency and layout transition before a step.
struct Barrier {
  uint32_t resource;
  VkPipelineStageFlags2 sourceStages, targetStages;
  VkAccessFlags2 sourceAccess, targetAccess;
  VkImageLayout oldLayout, newLayout;
  bool takesOver = false;  // memory in which something else was before
};

class FrameGraph {
 public:
  // Images and buffers that live within a frame.
  Handle addImage(std::string name, const ImageShape& shape);
  Handle addBuffer(std::string name, uint64_t bytes);
  // An image that holds at the beginning of a frame what the last one has left in it; a step that writes it
  // may leave it as it is.
  Handle addKeptImage(std::string name, const ImageShape& shape);
  // Those that live longer. `before` and `after`: how they are used outside. Without `before` they are as the
  // last frame has left them. With `after` they are handed on, so that what is written to them is always
  // wanted; without it they wait for the next frame.
  Handle importImage(std::string name, const ImageShape& shape, std::optional<Outside> before = {},
                     std::optional<Outside> after = {});
  Handle importBuffer(std::string name, std::optional<Outside> before = {},
                      std::optional<Outside> after = {});

  // Starts a step and returns its number; use() belongs to it until the next one starts.
  size_t addStep(std::string name);
  // What the step does with a resource, which may occur only once in a step. `handle` must be its newest
  // version, and have been written where it is read. Returns that version, or the one that is written; where
  // that is not the first, it continues what the one before holds.
  Handle use(Handle handle, Use use);

  struct Resource {
    std::string name;
    bool isImage = true, isImported = false, isKept = false;
    ImageShape shape;    // of an image
    uint64_t bytes = 0;  // of a buffer that is the graph's
    std::optional<Outside> before, after;
    uint32_t versions = 0;  // that were written
  };
  struct StepUse {
    Handle handle;  // the version that is read, or the new one
    Use use;
  };
  struct Step {
    std::string name;
    std::vector<StepUse> uses;
  };
  const std::vector<Resource>& resources() const { return resources_; }
  const std::vector<Step>& steps() const { return steps_; }
  const ImageShape& shape(Handle image) const { return resources_[image.resource].shape; }

  // What has to be done for some results.
  struct Needs {
    std::vector<bool> steps;  // by number: whether it is needed
    struct Life {
      bool isUsed = false;
      size_t first = 0, last = 0;  // numbers of the steps that use it
      VkImageUsageFlags imageUsage = 0;
      VkBufferUsageFlags bufferUsage = 0;
    };
    std::vector<Life> lives;  // by resource
  };
  // For these handles, and what is handed on.
  Needs needsOf(std::span<const Handle> wanted) const;

  // Barriers before each needed step (of the others none), and last those after all of them. The first use in
  // a frame waits for the last use in the frame before, and discards the contents of what lives within a
  // frame alone. `sharing`: for each resource those others that lie in the same memory at other times of the
  // frame; empty: none does.
  std::vector<std::vector<Barrier>> planBarriers(
      const Needs& needs, const std::vector<std::vector<uint32_t>>& sharing = {}) const;

  // Bytes of the images that a step reads and writes, each once and as a whole: what goes to and from memory
  // where caches hold what is near, and no tile is left out. Samples count; what a write continues is read.
  struct Traffic {
    uint64_t read = 0, written = 0;
    bool operator==(const Traffic&) const = default;
  };
  Traffic trafficOf(size_t step, const ImageShape::Frame& frame) const;

  // For Graphviz: steps are boxes, versions of images and buffers are ellipses; what is not needed is grey.
  std::string toDot(const Needs& needs, const ImageShape::Frame& frame) const;

 private:
  std::vector<Resource> resources_;
  std::vector<Step> steps_;
};

// Records the barriers before a step; `imageOf` gives null for buffers.
void recordBarriers(VkCommandBuffer commands, std::span<const Barrier> barriers,
                    const std::function<const Image*(uint32_t resource)>& imageOf);

}  // namespace scumble::gpu
