// What the frames of one scene are drawn with, as long as the configuration stays the same: passes with their
// pipelines, the graph of their steps, and images of one size.
#pragma once

#include <optional>

#include "renderer/deliver.h"
#include "renderer/pass_list.h"
#include "renderer/readback.h"
#include "scumble/renderer.h"

namespace scumble::renderer {

// What a setup is made for.
struct SetupKey {
  Configuration configuration;
  bool plain = false;
  bool readsBack = true;  // the picture, and these AOVs
  std::vector<std::string> aovs;
  std::vector<TargetKey> targets;  // images of others that it is drawn into
  std::vector<uint32_t> variants;  // Pass::variant, by pass
  size_t lights = 1;               // most of them that there may be
  bool operator==(const SetupKey&) const = default;
};

class Setup {
 public:
  Setup(gpu::Device& device, gpu::Samplers& samplers, ExampleTextures& examples, SceneOnGpu& scene,
        const PassList& passes, const SetupKey& key, glm::uvec2 size,
        const std::function<void(double)>& progress);
  ~Setup();
  Setup(const Setup&) = delete;
  Setup& operator=(const Setup&) = delete;

  const SetupKey& key() const { return key_; }
  glm::uvec2 size() const { return size_; }
  // Makes images anew where they have another size, and nothing else; no frame may be under way.
  void resize(glm::uvec2 size);
  // The scene's buffers have other names; no frame may be under way.
  void bindScene();

  // Whether a pass needs to know where everything was a frame before.
  bool needsPrevious() const { return needsPrevious_; }
  // Writes the uniforms of a frame, those of its passes last.
  void update(const FrameInput& input, const std::vector<shared::PunctualLight>& lights);
  // The images of the frame's targets, by TargetKey::image; before record().
  void setTargets(uint32_t slot, const std::vector<VkImage>& images);
  // Other views, for a frame that was recorded and not yet sent. `keepsPrevious`: where they were a frame
  // before stays as it was written.
  void latch(uint32_t slot, std::vector<shared::ViewUniforms> views, bool keepsPrevious);
  // Records a frame's commands but for uploads; `slot`: which of those in flight.
  void addUploads(std::vector<gpu::PerFrameBuffer*>& uploads) { uniforms_.addUploads(uploads); }
  void beginTimes(VkCommandBuffer commands, uint32_t slot) const;
  void record(VkCommandBuffer commands, uint32_t slot);
  // Of a frame that the device has ended.
  void readTimes(uint32_t slot, FrameStats& stats) const;
  struct Layer {
    std::string name;
    bool isOnce;  // one image for all views
    std::vector<Image> views;
  };
  std::vector<Layer> readLayers(uint32_t slot, const std::map<std::string, PixelFormat>& formats) const;
  // For Graphviz.
  std::string dot() const;
  const gpu::GraphResources& resources() const { return *resources_; }

 private:
  void declareTarget(const TargetKey& target, gpu::Handle picture);
  // Names the images in everything that uses them.
  void bind();
  gpu::ImageShape::Frame frameSize() const { return {size_.x, size_.y, key_.configuration.viewCount}; }
  void stamp(VkCommandBuffer commands, uint32_t slot, uint32_t query) const;

  gpu::Device& device_;
  const SceneOnGpu& scene_;
  SetupKey key_;
  glm::uvec2 size_;
  UniformMemory uniforms_;
  UniformSlice frameSlice_, lightSlice_;
  gpu::SetLayout frameLayout_;
  gpu::DescriptorSets frameSet_;
  std::optional<FrameBuilder> builder_;
  std::vector<std::unique_ptr<Pass>> passes_;
  std::vector<Pass*> needed_;
  // The picture first, then the AOVs of the key; without `readback`: the same images as the picture.
  struct Read {
    std::string name;
    bool isOnce = false;
    std::unique_ptr<Readback> readback;
  };
  std::vector<Read> reads_;
  std::vector<std::unique_ptr<Deliver>> delivers_;
  std::vector<gpu::Handle> targets_;  // by TargetKey::image
  std::vector<gpu::Image> foreign_[gpu::kFramesInFlight];
  gpu::FrameGraph::Needs needs_;
  std::vector<size_t> steps_;  // numbers of those that are needed
  bool needsPrevious_ = false;
  std::optional<gpu::GraphResources> resources_;
  VkQueryPool queries_[gpu::kFramesInFlight] = {};  // null where there are no timestamps
};

}  // namespace scumble::renderer
