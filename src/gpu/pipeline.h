// Pipelines, descriptor sets and samplers: the parts of Vulkan that passes touch.
#pragma once

#include <compare>
#include <cstddef>
#include <initializer_list>
#include <map>
#include <span>
#include <vector>

#include "gpu/resources.h"

namespace scumble::gpu {

// SPIR-V that the build compiled and validated.
struct Shader {
  std::span<const uint32_t> words;
};

// One entry of a descriptor set's layout; the binding number is the position in the list.
struct Binding {
  VkDescriptorType type;
  VkShaderStageFlags stages;
  auto operator<=>(const Binding&) const = default;
};

// Made once for each list of bindings; the device keeps it.
class SetLayout {
 public:
  SetLayout() = default;
  SetLayout(Device& device, std::vector<Binding> bindings);
  VkDescriptorSetLayout handle() const { return layout_; }
  const std::vector<Binding>& bindings() const { return bindings_; }

 private:
  VkDescriptorSetLayout layout_ = VK_NULL_HANDLE;
  std::vector<Binding> bindings_;
};

// `count` descriptor sets of one layout.
class DescriptorSets {
 public:
  DescriptorSets() = default;
  DescriptorSets(Device& device, const SetLayout& layout, uint32_t count = 1);
  ~DescriptorSets();
  DescriptorSets(DescriptorSets&& other) noexcept { swap(other); }
  DescriptorSets& operator=(DescriptorSets&& other) noexcept {
    swap(other);
    return *this;
  }
  VkDescriptorSet operator[](size_t index) const { return sets_[index]; }
  size_t size() const { return sets_.size(); }
  void writeBuffer(size_t set, uint32_t binding, VkBuffer buffer, uint64_t offset = 0,
                   uint64_t size = VK_WHOLE_SIZE);
  // Does nothing where this very texture was the last one written there: passes may say it every frame. Views
  // that are written stay as long as the sets.
  void writeTexture(size_t set, uint32_t binding, VkImageView view, VkSampler sampler);
  // The same for views that come and go: a new one may have an old one's name.
  void rewriteTexture(size_t set, uint32_t binding, VkImageView view, VkSampler sampler);
  void writeStorageImage(size_t set, uint32_t binding, VkImageView view);

 private:
  void swap(DescriptorSets& other);
  void write(size_t set, uint32_t binding, const VkDescriptorBufferInfo* buffer,
             const VkDescriptorImageInfo* image);
  Device* device_ = nullptr;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  std::vector<VkDescriptorSet> sets_;
  std::vector<Binding> bindings_;
  std::vector<std::pair<VkImageView, VkSampler>> textures_;  // by set, then by binding
};

// Of what is drawn and what is there: it lies over it, with colours as they are or times their alpha; or the
// greater of both stays, channel by channel.
enum class Blend : uint8_t { none, over, premultiplied, greatest };

struct GraphicsPipelineDesc {
  Shader vertex, fragment;          // no fragment shader: depth only
  std::vector<uint32_t> constants;  // specialisation constants 0, 1, ... of both shaders
  std::vector<VkVertexInputAttributeDescription> vertexAttributes;  // strides come with the buffers
  std::vector<VkFormat> colorFormats;
  Blend blend = Blend::none;                   // of all targets
  VkFormat depthFormat = VK_FORMAT_UNDEFINED;  // undefined: no depth test
  VkCompareOp depthCompare = VK_COMPARE_OP_GREATER_OR_EQUAL;
  bool depthWrite = true;
  // Fragments are tested as if they were nearer by so many times what depth changes over a pixel (reversed
  // Z).
  float depthSlack = 0;
  uint32_t samples = 1;
  uint32_t viewMask = 0;        // 0: no multiview
  bool dynamicCulling = false;  // cull mode and front face are set while recording
  std::vector<VkDescriptorSetLayout> sets;
  uint32_t pushConstantBytes = 0;  // seen by all stages
};

struct ComputePipelineDesc {
  Shader shader;
  std::vector<uint32_t> constants;
  std::vector<VkDescriptorSetLayout> sets;
  uint32_t pushConstantBytes = 0;
};

// Compiled once for each description; the device keeps it, so that another size of the picture, or a part of
// it that is switched on and off again, compiles nothing anew.
class Pipeline {
 public:
  Pipeline() = default;
  Pipeline(Device& device, const GraphicsPipelineDesc& desc);
  Pipeline(Device& device, const ComputePipelineDesc& desc);
  VkPipelineLayout layout() const { return layout_; }
  void bind(VkCommandBuffer commands) const { vkCmdBindPipeline(commands, bindPoint_, pipeline_); }
  void bindSet(VkCommandBuffer commands, uint32_t index, VkDescriptorSet set,
               std::span<const uint32_t> dynamicOffsets = {}) const {
    vkCmdBindDescriptorSets(commands, bindPoint_, layout_, index, 1, &set, uint32_t(dynamicOffsets.size()),
                            dynamicOffsets.data());
  }
  void push(VkCommandBuffer commands, uint32_t constant) const { push(commands, {constant}); }
  void push(VkCommandBuffer commands, std::initializer_list<uint32_t> constants) const {
    vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_ALL, 0, uint32_t(constants.size() * 4),
                       constants.begin());
  }
  // All of them, as the shader's block has them.
  template <class Block>
  void pushAll(VkCommandBuffer commands, const Block& block) const {
    vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_ALL, 0, sizeof(Block), &block);
  }
  explicit operator bool() const { return pipeline_ != VK_NULL_HANDLE; }

 private:
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
  VkPipelineBindPoint bindPoint_ = VK_PIPELINE_BIND_POINT_GRAPHICS;
};

// What a device has made of set layouts and pipelines, by what they were made from. Shaders count by where
// their words stand, which is the same as long as the process runs.
class PipelineStore {
 public:
  explicit PipelineStore(VkDevice device) : device_(device) {}
  ~PipelineStore();
  PipelineStore(const PipelineStore&) = delete;
  PipelineStore& operator=(const PipelineStore&) = delete;

  using Key = std::vector<uint64_t>;
  struct Made {
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkPipeline pipeline = VK_NULL_HANDLE;
  };
  VkDescriptorSetLayout& setLayout(const std::vector<Binding>& bindings) { return setLayouts_[bindings]; }
  Made& pipeline(Key key) { return pipelines_[std::move(key)]; }
  // How many pipelines have been compiled since the start.
  uint32_t made() const { return uint32_t(pipelines_.size()); }

 private:
  VkDevice device_;
  std::map<std::vector<Binding>, VkDescriptorSetLayout> setLayouts_;
  std::map<Key, Made> pipelines_;
};

struct SamplerDesc {
  VkFilter filter = VK_FILTER_LINEAR;
  VkSamplerAddressMode wrapU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                       wrapV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  bool mipmaps = false;
  bool compareLess = false;  // depth comparison, for shadow maps
  // The one mip level that is read, which saves drivers its computation; -1: all of them.
  float onlyLevel = -1;
  bool operator==(const SamplerDesc&) const = default;
};

// Samplers, each made once.
class Samplers {
 public:
  explicit Samplers(Device& device) : device_(device) {}
  ~Samplers();
  VkSampler get(const SamplerDesc& desc);

 private:
  Device& device_;
  std::vector<std::pair<SamplerDesc, VkSampler>> samplers_;
};

}  // namespace scumble::gpu
