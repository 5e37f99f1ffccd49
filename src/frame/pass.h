// The contract of a pass. A pass declares its steps (what each reads and writes, and how it records) once for
// a configuration of the renderer; then, when the images exist, makes its pipelines and descriptor sets;
// then, each frame, writes its uniforms. It sees the frame, the scene on the GPU and the look; no file, no
// window, no other pass.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "frame/backdrop.h"
#include "frame/example_textures.h"
#include "frame/scene_on_gpu.h"
#include "frame/slots.h"
#include "gpu/frame_graph.h"
#include "gpu/pipeline.h"
#include "gpu/view_drawing.h"
#include "look/look_data.h"
#include "shading/frame.shared.h"

namespace scumble::frame {

// A piece of the renderer's uniform buffer; written by the CPU before the frame, read as uniform or storage
// buffer.
struct UniformSlice {
  VkBuffer buffer = VK_NULL_HANDLE;
  uint64_t offset = 0, size = 0;
  std::byte* mapped = nullptr;
  template <class T>
  void write(const T& value) const {
    std::memcpy(mapped, &value, sizeof(T));
  }
};

// What is fixed as long as images and pipelines live.
struct Configuration {
  uint32_t width = 0, height = 0, samples = 1, viewCount = 1;
  bool computeImagePasses = false;
  bool facts = false;          // whether the facts pass runs
  bool matte = false;          // whether the matte pass runs
  std::vector<Slot> readBack;  // what the caller gets
  bool layered = false;        // whether what lies behind the first surface is drawn as well
  bool glows = false;          // whether anything may act on the lens
  bool limit = false;          // whether the limit pass runs
  uint32_t backdropWidth = 0,
           backdropHeight = 0;  // texels of the picture behind everything; 0: there is none
  bool plain = false;
  bool ocean = false;     // whether the ocean pass runs
  bool colorize = false;  // whether the colorize pass runs
  gpu::ViewDrawing viewDrawing = gpu::ViewDrawing::together;
  bool operator==(const Configuration&) const = default;

  gpu::Views views() const { return {viewCount, viewDrawing}; }

  // Where the colours are that become the picture, and before the limit pass.
  Slot colors() const { return limit ? Slot::limit : colorsToLimit(); }
  Slot colorsBehind() const { return limit ? Slot::behindLimit : colorsToLimitBehind(); }
  Slot colorsToLimit() const { return colorize ? Slot::colorize : Slot::color; }
  Slot colorsToLimitBehind() const { return colorize ? Slot::behindColorize : Slot::behind; }
};

// What changes from frame to frame.
struct FrameInput {
  const look::LookData& look;  // at the frame's time
  double time = 0;             // seconds
  const shared::FrameUniforms& uniforms;
  const SceneOnGpu& scene;
  bool transparent = false;  // nothing is laid behind what is drawn, or something is later: `backdrop`
  uint32_t seed = 0;
  const BackdropInput* backdrop = nullptr;  // where there is a picture behind everything
};

using Record = std::function<void(VkCommandBuffer)>;

// Collects the steps of all passes.
class FrameBuilder {
 public:
  FrameBuilder(gpu::Device& device, gpu::Samplers& samplers, ExampleTextures& examples,
               const Configuration& configuration, const SceneOnGpu& scene, UniformSlice uniformMemory);

  gpu::Device& device() { return device_; }
  gpu::Samplers& samplers() { return samplers_; }
  ExampleTextures& examples() { return examples_; }
  const Configuration& configuration() const { return configuration_; }
  const SceneOnGpu& scene() const { return scene_; }

  // The image of a slot; made when it is first named.
  gpu::ResourceId slot(Slot slot);
  // The multisampled image that is resolved into the slot's; only where the configuration has samples.
  gpu::ResourceId multisampled(Slot slot);
  // The final vertices that `deform` writes.
  gpu::ResourceId finalVertices() const { return finalVertices_; }
  // An image of the pass's own.
  gpu::ResourceId transient(std::string name, const gpu::ImageDesc& desc) {
    return graph_.addImage(std::move(name), desc);
  }

  void addStep(const std::string& name, std::vector<gpu::ResourceUse> uses, Record record);
  UniformSlice uniform(uint64_t bytes);

  const gpu::FrameGraph& graph() const { return graph_; }
  const std::vector<Record>& records() const { return records_; }

 private:
  static constexpr gpu::ResourceId kNone = ~0u;
  gpu::Device& device_;
  gpu::Samplers& samplers_;
  ExampleTextures& examples_;
  Configuration configuration_;
  const SceneOnGpu& scene_;
  UniformSlice uniformMemory_;
  uint64_t uniformUsed_ = 0;
  gpu::FrameGraph graph_;
  std::vector<Record> records_;
  std::vector<gpu::ResourceId> slots_, multisampled_;
  gpu::ResourceId finalVertices_;
};

// The images and the frame's own descriptor set, when they exist.
class FrameResources {
 public:
  FrameResources(gpu::Device& device, const FrameBuilder& builder, const gpu::SetLayout& frameLayout,
                 VkDescriptorSet frameSet);
  const gpu::Image& image(gpu::ResourceId id) const { return images_[id]; }
  const gpu::SetLayout& frameLayout() const { return frameLayout_; }
  VkDescriptorSet frameSet() const { return frameSet_; }

 private:
  std::vector<gpu::Image> images_;
  const gpu::SetLayout& frameLayout_;
  VkDescriptorSet frameSet_;
};

class Pass {
 public:
  virtual ~Pass() = default;
  virtual const char* name() const = 0;
  virtual void declare(FrameBuilder& frame) = 0;
  virtual void create(FrameBuilder& frame, const FrameResources& resources) = 0;
  virtual void update(const FrameInput&) {}
};

}  // namespace scumble::frame
