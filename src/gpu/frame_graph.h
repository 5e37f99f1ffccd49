// The frame graph: which step reads and writes what, and from that the barriers. Steps run in the order in
// which they were added; nothing is reordered. It plans only, and knows no device, so it is tested without
// one.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "gpu/resources.h"

namespace scumble::gpu {

// What a step does with a resource.
enum class Use : uint8_t {
  sampledByFragment,
  sampledByCompute,
  colorTarget,
  depthTarget,
  resolveTarget,       // of a multisampled colour target
  depthResolveTarget,  // of a multisampled depth target
  storageImageWrite,   // by compute
  storageBufferRead,   // by compute
  storageBufferWrite,  // by compute
  vertexBuffer,
  copySource
};

struct UseInfo {
  VkPipelineStageFlags2 stages;
  VkAccessFlags2 access;
  VkImageLayout layout;  // undefined for buffers
  VkImageUsageFlags imageUsage;
  bool writes;
};
UseInfo useInfo(Use use);

using ResourceId = uint32_t;

struct ResourceUse {
  ResourceId resource;
  Use use;
};

// A memory dependency and layout transition before a step.
struct Barrier {
  ResourceId resource;
  VkPipelineStageFlags2 sourceStages, targetStages;
  VkAccessFlags2 sourceAccess, targetAccess;
  VkImageLayout oldLayout, newLayout;
};

class FrameGraph {
 public:
  ResourceId addImage(std::string name, const ImageDesc& desc);
  ResourceId addBuffer(std::string name);

  // Adds a step; returns its index. A resource may occur only once among a step's uses, and must have been
  // written by an earlier step before it is read.
  size_t addStep(std::string name, std::vector<ResourceUse> uses);

  struct ResourceInfo {
    std::string name;
    bool isImage;
    ImageDesc desc;
    VkImageUsageFlags usage = 0;  // of all its uses
  };
  struct Step {
    std::string name;
    std::vector<ResourceUse> uses;
  };
  const std::vector<ResourceInfo>& resources() const { return resources_; }
  const std::vector<Step>& steps() const { return steps_; }

  // Barriers before each step, index by index. The first use in a frame waits for the last use in the frame
  // before and discards an image's contents: no step sees an earlier frame.
  std::vector<std::vector<Barrier>> planBarriers() const;

 private:
  std::vector<ResourceInfo> resources_;
  std::vector<Step> steps_;
};

// Records the barriers before a step; `imageOf` gives null for buffers.
void recordBarriers(VkCommandBuffer commands, std::span<const Barrier> barriers,
                    const std::function<const Image*(ResourceId)>& imageOf);

}  // namespace scumble::gpu
