// The contract of a pass. A pass declares its steps (what each reads and writes, and how it records) once for
// a configuration of the renderer; makes its pipelines and descriptor sets, where what it writes is needed;
// names the images in those sets whenever they are made anew, for another size; then, each frame, writes its
// uniforms. It sees the frame, the scene on the GPU and the look; no file, no window, no other pass.
#pragma once

#include <cstring>
#include <deque>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "frame/aov.h"
#include "frame/formats.h"
#include "frame/roles.h"
#include "gpu/frames_in_flight.h"
#include "gpu/graph_resources.h"
#include "gpu/pipeline.h"
#include "gpu/view_drawing.h"
#include "look/look_data.h"
#include "shading/frame.shared.h"
#include "stage/knob_table.h"
#include "world/backdrop.h"
#include "world/example_textures.h"
#include "world/scene_on_gpu.h"

namespace scumble::frame {

using namespace stage;
using namespace world;

// What is fixed as long as pipelines live.
struct Configuration {
  uint32_t samples = 1, viewCount = 1;
  bool computeImagePasses = false;
  gpu::ViewDrawing viewDrawing = gpu::ViewDrawing::together;
  bool hasBackdrop = false;  // there is a picture behind everything
  bool onSphere = false;     // the frame is a part of a sphere
  bool operator==(const Configuration&) const = default;

  gpu::Views views() const { return {viewCount, viewDrawing}; }
};

// A piece of the frame's uniform memory; written by the CPU before the frame, read as uniform or storage
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

// Uniform memory, as much as is asked for.
class UniformMemory {
 public:
  explicit UniformMemory(gpu::Device& device) : device_(device) {}
  UniformSlice slice(uint64_t bytes);
  void addUploads(std::vector<gpu::PerFrameBuffer*>& uploads);
  // Takes a slice once more into uploads of a frame that were recorded, and not yet sent.
  void amend(const UniformSlice& slice, uint32_t frame);

 private:
  gpu::Device& device_;
  std::deque<gpu::PerFrameBuffer> blocks_;  // slices point into them
  uint64_t used_ = 0;                       // of the last one
};

// What changes from frame to frame.
struct FrameInput {
  const look::LookData& look;  // at the frame's time
  const KnobTable& knobs;      // the same, by the scene's materials
  double time = 0;             // seconds
  const shared::FrameUniforms& uniforms;
  const SceneOnGpu& scene;
  float inflation = 0;       // how far outside of its silhouette any surface tears edges, pixels
  bool transparent = false;  // nothing is laid behind what is drawn, or something is later: `backdrop`
  uint32_t seed = 0;
  const BackdropInput* backdrop = nullptr;  // where there is a picture behind everything
};

using Record = std::function<void(VkCommandBuffer)>;

// What casts shadows and is no surface: it is drawn into the shadow map after those.
struct Caster {
  // Into the map's depth buffer, nearest to the light first to count.
  Record draw;
  // Another number whenever it would draw another thing: as long as it is the same, the map may be kept.
  std::function<uint64_t()> version;
  // Buffers that it reads.
  std::vector<std::pair<gpu::Handle, gpu::Use>> reads;
};

class Pass;

// What passes build a frame from.
class FrameBuilder {
 public:
  FrameBuilder(gpu::Device& device, gpu::Samplers& samplers, ExampleTextures& examples,
               const Configuration& configuration, const SceneOnGpu& scene, const gpu::SetLayout& frameLayout,
               VkDescriptorSet frameSet, UniformMemory& uniforms, std::vector<std::string> asked);

  gpu::Device& device() { return device_; }
  gpu::Samplers& samplers() { return samplers_; }
  ExampleTextures& examples() { return examples_; }
  const Configuration& configuration() const { return configuration_; }
  const SceneOnGpu& scene() const { return scene_; }
  // Set 0 of all pipelines (shading/frame.glsl).
  const gpu::SetLayout& frameLayout() const { return frameLayout_; }
  VkDescriptorSet frameSet() const { return frameSet_; }

  // -- While a pass declares.
  // What has a role now. It must have been given.
  gpu::Handle get(const Role& role, Layer layer = Layer::first) const;
  bool has(const Role& role, Layer layer = Layer::first) const;
  // Whether somebody saves an AOV: it is then made in full, also where the picture does not need it.
  bool isAsked(const Aov& aov) const;
  // From here on `handle` has the role.
  void give(const Role& role, gpu::Handle handle, Layer layer = Layer::first);
  // Images and buffers of the pass's own; what comes back is empty until a step writes it.
  gpu::Handle image(std::string name, const gpu::ImageShape& shape) {
    return graph_.addImage(std::move(name), shape);
  }
  // One that stays from frame to frame as it was left, until bind() is called.
  gpu::Handle keptImage(std::string name, const gpu::ImageShape& shape) {
    return graph_.addKeptImage(std::move(name), shape);
  }
  gpu::Handle buffer(std::string name, uint64_t bytes) { return graph_.addBuffer(std::move(name), bytes); }
  // The next step; `record` is called for each frame, where what it writes is needed.
  void step(const std::string& name, Record record);
  // What that step does with a handle (gpu::FrameGraph::use): the version that it has from then on.
  gpu::Handle use(gpu::Handle handle, gpu::Use use) { return graph_.use(handle, use); }
  // How many texels the step takes for each one of an image that it writes: a part of its cost.
  void countFetches(gpu::Handle image, uint32_t perTexel) { fetches_.back() = {image, perTexel}; }
  // Lets users save images, of one size and format, as one of the pass's aovs().
  void offer(const Aov& aov, std::vector<gpu::Handle> images);
  const gpu::ImageShape& shape(gpu::Handle image) const { return graph_.shape(image); }
  // For passes before the shadow map's, which draws them.
  void addCaster(Caster caster) { casters_.push_back(std::move(caster)); }
  const std::vector<Caster>& casters() const { return casters_; }

  // -- While it creates.
  UniformSlice uniform(uint64_t bytes) { return uniforms_.slice(bytes); }

  // -- For who calls the passes.
  void declare(Pass& pass, uint32_t variant);
  gpu::FrameGraph& graph() { return graph_; }
  const gpu::FrameGraph& graph() const { return graph_; }
  const std::vector<Record>& records() const { return records_; }
  // Of a step, in all.
  uint64_t fetchesOf(size_t step, const gpu::ImageShape::Frame& frame) const;
  // What was offered under a name; null: nothing.
  struct Offer {
    const Aov* aov;
    std::vector<gpu::Handle> images;
  };
  const Offer* offered(const std::string& name) const;
  // Whether any step that a pass has declared is needed.
  bool needs(const Pass& pass, const gpu::FrameGraph::Needs& needs) const;

 private:
  struct Given {
    const Role* role;
    Layer layer;
    gpu::Handle handle;
  };
  const Given* find(const Role& role, Layer layer) const;

  gpu::Device& device_;
  gpu::Samplers& samplers_;
  ExampleTextures& examples_;
  Configuration configuration_;
  const SceneOnGpu& scene_;
  const gpu::SetLayout& frameLayout_;
  VkDescriptorSet frameSet_;
  UniformMemory& uniforms_;
  std::vector<std::string> asked_;  // names of AOVs
  gpu::FrameGraph graph_;
  std::vector<Record> records_;  // by step
  struct Fetches {
    gpu::Handle image{};
    uint32_t perTexel = 0;
  };
  std::vector<Fetches> fetches_;        // by step
  std::vector<const Pass*> declarers_;  // by step
  const Pass* declaring_ = nullptr;
  std::vector<Given> given_;
  std::vector<Offer> offers_;
  std::vector<Caster> casters_;
};

class Pass {
 public:
  virtual ~Pass() = default;
  virtual const char* name() const = 0;
  // What it may offer, by the names that users know.
  virtual std::span<const Aov> aovs() const { return {}; }
  // What of scene and look decides which steps it declares: when it changes, a frame is built anew.
  virtual uint32_t variant(const scene::SceneData&, const look::LookData&) const { return 0; }
  virtual void declare(FrameBuilder& frame, uint32_t variant) = 0;
  // From here on only for passes that are needed. `frame` stays as long as the pass.
  virtual void create(FrameBuilder& frame) = 0;
  // After create(), and whenever images or the scene's buffers were made anew; `resources` stay as long as
  // the pass.
  virtual void bind(const gpu::GraphResources& resources) = 0;
  virtual void update(const FrameInput&) {}
};

}  // namespace scumble::frame
