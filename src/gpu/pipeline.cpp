#include "gpu/pipeline.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <map>
#include <set>

namespace scumble::gpu {

namespace {

class ShaderModule {
 public:
  ShaderModule(Device& device, Shader shader) : device_(device) {
    if (const auto other = device.replacedShaders().find(shader.words.data());
        other != device.replacedShaders().end())
      shader.words = other->second;
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = shader.words.size_bytes();
    info.pCode = shader.words.data();
    SCUMBLE_VK(vkCreateShaderModule(device.handle(), &info, nullptr, &module_));
  }
  ~ShaderModule() { vkDestroyShaderModule(device_.handle(), module_, nullptr); }
  ShaderModule(const ShaderModule&) = delete;
  VkShaderModule handle() const { return module_; }

 private:
  Device& device_;
  VkShaderModule module_;
};

// Specialisation constants that are numbered 0, 1, ... and are 32 bits wide.
struct Constants {
  explicit Constants(const std::vector<uint32_t>& values) {
    for (uint32_t i = 0; i < values.size(); ++i) entries.push_back({i, 4 * i, 4});
    info = {uint32_t(entries.size()), entries.data(), values.size() * 4, values.data()};
  }
  std::vector<VkSpecializationMapEntry> entries;
  VkSpecializationInfo info;
};

VkPipelineShaderStageCreateInfo shaderStage(VkShaderStageFlagBits stage, const ShaderModule& module,
                                            const Constants& constants) {
  VkPipelineShaderStageCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
  info.stage = stage;
  info.module = module.handle();
  info.pName = "main";
  info.pSpecializationInfo = &constants.info;
  return info;
}

}  // namespace

SetLayout::SetLayout(Device& device, std::vector<Binding> bindings) : bindings_(std::move(bindings)) {
  VkDescriptorSetLayout& made = device.pipelines().setLayout(bindings_);
  if (!made) {
    std::vector<VkDescriptorSetLayoutBinding> entries;
    for (uint32_t i = 0; i < bindings_.size(); ++i)
      entries.push_back({i, bindings_[i].type, 1, bindings_[i].stages, nullptr});
    VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    info.bindingCount = uint32_t(entries.size());
    info.pBindings = entries.data();
    SCUMBLE_VK(vkCreateDescriptorSetLayout(device.handle(), &info, nullptr, &made));
  }
  layout_ = made;
}

DescriptorSets::DescriptorSets(Device& device, const SetLayout& layout, uint32_t count)
    : device_(&device), bindings_(layout.bindings()), textures_(count * bindings_.size()) {
  std::map<VkDescriptorType, uint32_t> counts;
  for (const Binding& binding : bindings_) counts[binding.type] += count;
  std::vector<VkDescriptorPoolSize> sizes;
  for (const auto& [type, needed] : counts) sizes.push_back({type, needed});
  VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  info.maxSets = count;
  info.poolSizeCount = uint32_t(sizes.size());
  info.pPoolSizes = sizes.data();
  SCUMBLE_VK(vkCreateDescriptorPool(device.handle(), &info, nullptr, &pool_));
  const std::vector<VkDescriptorSetLayout> layouts(count, layout.handle());
  VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
  allocate.descriptorPool = pool_;
  allocate.descriptorSetCount = count;
  allocate.pSetLayouts = layouts.data();
  sets_.resize(count);
  SCUMBLE_VK(vkAllocateDescriptorSets(device.handle(), &allocate, sets_.data()));
}

DescriptorSets::~DescriptorSets() {
  if (pool_) vkDestroyDescriptorPool(device_->handle(), pool_, nullptr);
}

void DescriptorSets::swap(DescriptorSets& other) {
  std::swap(device_, other.device_);
  std::swap(pool_, other.pool_);
  std::swap(sets_, other.sets_);
  std::swap(bindings_, other.bindings_);
  std::swap(textures_, other.textures_);
}

void DescriptorSets::write(size_t set, uint32_t binding, const VkDescriptorBufferInfo* buffer,
                           const VkDescriptorImageInfo* image) {
  device_->waitForSubmissions();
  VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
  write.dstSet = sets_[set];
  write.dstBinding = binding;
  write.descriptorCount = 1;
  write.descriptorType = bindings_[binding].type;
  write.pBufferInfo = buffer;
  write.pImageInfo = image;
  vkUpdateDescriptorSets(device_->handle(), 1, &write, 0, nullptr);
}

void DescriptorSets::writeBuffer(size_t set, uint32_t binding, VkBuffer buffer, uint64_t offset,
                                 uint64_t size) {
  const VkDescriptorBufferInfo info{buffer, offset, size};
  write(set, binding, &info, nullptr);
}

void DescriptorSets::writeTexture(size_t set, uint32_t binding, VkImageView view, VkSampler sampler) {
  const std::pair<VkImageView, VkSampler>& last = textures_[set * bindings_.size() + binding];
  if (last != std::pair(view, sampler)) rewriteTexture(set, binding, view, sampler);
}

void DescriptorSets::rewriteTexture(size_t set, uint32_t binding, VkImageView view, VkSampler sampler) {
  textures_[set * bindings_.size() + binding] = {view, sampler};
  const VkDescriptorImageInfo info{sampler, view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  write(set, binding, nullptr, &info);
}

void DescriptorSets::writeStorageImage(size_t set, uint32_t binding, VkImageView view) {
  const VkDescriptorImageInfo info{VK_NULL_HANDLE, view, VK_IMAGE_LAYOUT_GENERAL};
  write(set, binding, nullptr, &info);
}

namespace {

// A description as numbers; lists begin with their length, so that no two descriptions have the same.
class KeyWriter {
 public:
  PipelineStore::Key key;
  KeyWriter& number(uint64_t value) {
    key.push_back(value);
    return *this;
  }
  KeyWriter& shader(const Shader& shader) {
    return number(reinterpret_cast<uintptr_t>(shader.words.data())).number(shader.words.size());
  }
  KeyWriter& numbers(const auto& list) {
    number(list.size());
    for (const auto& value : list) number(uint64_t(value));
    return *this;
  }
  KeyWriter& handles(const auto& list) {
    number(list.size());
    for (const auto& handle : list) number(reinterpret_cast<uintptr_t>(handle));
    return *this;
  }
};

VkPipelineLayout pipelineLayout(Device& device, const std::vector<VkDescriptorSetLayout>& sets,
                                uint32_t pushConstantBytes) {
  const VkPushConstantRange range{VK_SHADER_STAGE_ALL, 0, pushConstantBytes};
  VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  info.setLayoutCount = uint32_t(sets.size());
  info.pSetLayouts = sets.data();
  info.pushConstantRangeCount = pushConstantBytes > 0;
  info.pPushConstantRanges = &range;
  VkPipelineLayout layout;
  SCUMBLE_VK(vkCreatePipelineLayout(device.handle(), &info, nullptr, &layout));
  return layout;
}

void make(Device& device, const ComputePipelineDesc& desc, PipelineStore::Made& made) {
  if (!made.layout) made.layout = pipelineLayout(device, desc.sets, desc.pushConstantBytes);
  const ShaderModule module(device, desc.shader);
  const Constants constants(desc.constants);
  VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
  info.stage = shaderStage(VK_SHADER_STAGE_COMPUTE_BIT, module, constants);
  info.layout = made.layout;
  SCUMBLE_VK(
      vkCreateComputePipelines(device.handle(), device.pipelineCache(), 1, &info, nullptr, &made.pipeline));
  device.name(VK_OBJECT_TYPE_PIPELINE, made.pipeline, device.nameOfShader(desc.shader.words.data()));
}

void make(Device& device, const GraphicsPipelineDesc& desc, PipelineStore::Made& made) {
  if (!made.layout) made.layout = pipelineLayout(device, desc.sets, desc.pushConstantBytes);

  // Shaders.
  const Constants constants(desc.constants);
  const ShaderModule vertex(device, desc.vertex);
  std::vector<VkPipelineShaderStageCreateInfo> stages{
      shaderStage(VK_SHADER_STAGE_VERTEX_BIT, vertex, constants)};
  std::unique_ptr<ShaderModule> fragment;
  if (!desc.fragment.words.empty()) {
    fragment = std::make_unique<ShaderModule>(device, desc.fragment);
    stages.push_back(shaderStage(VK_SHADER_STAGE_FRAGMENT_BIT, *fragment, constants));
  }

  // Fixed functions.
  std::set<uint32_t> used;
  for (const VkVertexInputAttributeDescription& attribute : desc.vertexAttributes)
    used.insert(attribute.binding);
  std::vector<VkVertexInputBindingDescription> bindings;
  for (const uint32_t binding : used) bindings.push_back({binding, 0, VK_VERTEX_INPUT_RATE_VERTEX});
  VkPipelineVertexInputStateCreateInfo vertexInput{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
  vertexInput.vertexBindingDescriptionCount = uint32_t(bindings.size());
  vertexInput.pVertexBindingDescriptions = bindings.data();
  vertexInput.vertexAttributeDescriptionCount = uint32_t(desc.vertexAttributes.size());
  vertexInput.pVertexAttributeDescriptions = desc.vertexAttributes.data();
  VkPipelineInputAssemblyStateCreateInfo assembly{
      VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
  viewport.viewportCount = viewport.scissorCount = 1;
  VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
  raster.cullMode = VK_CULL_MODE_NONE;
  raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
  raster.lineWidth = 1.0f;
  raster.depthBiasEnable = desc.depthSlack != 0;
  raster.depthBiasSlopeFactor = desc.depthSlack;
  VkPipelineMultisampleStateCreateInfo multisample{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
  multisample.rasterizationSamples = VkSampleCountFlagBits(desc.samples);
  VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
  depth.depthTestEnable = desc.depthFormat != VK_FORMAT_UNDEFINED;
  depth.depthWriteEnable = depth.depthTestEnable && desc.depthWrite;
  depth.depthCompareOp = desc.depthCompare;
  // What it draws into.
  VkPipelineColorBlendAttachmentState target{};
  target.colorWriteMask = 0xF;
  if (desc.blend == Blend::over || desc.blend == Blend::premultiplied) {
    target.blendEnable = VK_TRUE;
    target.srcColorBlendFactor = desc.blend == Blend::over ? VK_BLEND_FACTOR_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
    target.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    target.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    target.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
  }
  if (desc.blend == Blend::greatest) {
    target.blendEnable = VK_TRUE;
    target.srcColorBlendFactor = target.dstColorBlendFactor = VK_BLEND_FACTOR_ONE;
    target.srcAlphaBlendFactor = target.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    target.colorBlendOp = target.alphaBlendOp = VK_BLEND_OP_MAX;
  }
  const std::vector<VkPipelineColorBlendAttachmentState> targets(desc.colorFormats.size(), target);
  VkPipelineColorBlendStateCreateInfo blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
  blend.attachmentCount = uint32_t(targets.size());
  blend.pAttachments = targets.data();
  std::vector<VkDynamicState> dynamic{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  if (!bindings.empty()) dynamic.push_back(VK_DYNAMIC_STATE_VERTEX_INPUT_BINDING_STRIDE);
  if (desc.dynamicCulling)
    dynamic.insert(dynamic.end(), {VK_DYNAMIC_STATE_CULL_MODE, VK_DYNAMIC_STATE_FRONT_FACE});
  VkPipelineDynamicStateCreateInfo dynamicState{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
  dynamicState.dynamicStateCount = uint32_t(dynamic.size());
  dynamicState.pDynamicStates = dynamic.data();
  VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
  rendering.viewMask = desc.viewMask;
  rendering.colorAttachmentCount = uint32_t(desc.colorFormats.size());
  rendering.pColorAttachmentFormats = desc.colorFormats.data();
  rendering.depthAttachmentFormat = desc.depthFormat;

  // All of it.
  VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering};
  info.stageCount = uint32_t(stages.size());
  info.pStages = stages.data();
  info.pVertexInputState = &vertexInput;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewport;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &multisample;
  info.pDepthStencilState = &depth;
  info.pColorBlendState = &blend;
  info.pDynamicState = &dynamicState;
  info.layout = made.layout;
  SCUMBLE_VK(
      vkCreateGraphicsPipelines(device.handle(), device.pipelineCache(), 1, &info, nullptr, &made.pipeline));
  const Shader& last = desc.fragment.words.empty() ? desc.vertex : desc.fragment;
  device.name(VK_OBJECT_TYPE_PIPELINE, made.pipeline, device.nameOfShader(last.words.data()));
}

}  // namespace

Pipeline::Pipeline(Device& device, const ComputePipelineDesc& desc)
    : bindPoint_(VK_PIPELINE_BIND_POINT_COMPUTE) {
  KeyWriter writer;
  writer.number(bindPoint_)
      .shader(desc.shader)
      .numbers(desc.constants)
      .handles(desc.sets)
      .number(desc.pushConstantBytes);
  PipelineStore::Made& made = device.pipelines().pipeline(std::move(writer.key));
  if (!made.pipeline) make(device, desc, made);
  layout_ = made.layout, pipeline_ = made.pipeline;
}

Pipeline::Pipeline(Device& device, const GraphicsPipelineDesc& desc) {
  KeyWriter writer;
  writer.number(bindPoint_).shader(desc.vertex).shader(desc.fragment).numbers(desc.constants);
  writer.number(desc.vertexAttributes.size());
  for (const VkVertexInputAttributeDescription& attribute : desc.vertexAttributes)
    writer.number(attribute.location)
        .number(attribute.binding)
        .number(attribute.format)
        .number(attribute.offset);
  writer.numbers(desc.colorFormats).number(uint64_t(desc.blend));
  writer.number(desc.depthFormat).number(desc.depthCompare).number(desc.depthWrite);
  writer.number(std::bit_cast<uint32_t>(desc.depthSlack));
  writer.number(desc.samples).number(desc.viewMask).number(desc.dynamicCulling);
  writer.handles(desc.sets).number(desc.pushConstantBytes);
  PipelineStore::Made& made = device.pipelines().pipeline(std::move(writer.key));
  if (!made.pipeline) make(device, desc, made);
  layout_ = made.layout, pipeline_ = made.pipeline;
}

PipelineStore::~PipelineStore() {
  for (const auto& [key, made] : pipelines_) {
    if (made.pipeline) vkDestroyPipeline(device_, made.pipeline, nullptr);
    if (made.layout) vkDestroyPipelineLayout(device_, made.layout, nullptr);
  }
  for (const auto& [bindings, layout] : setLayouts_)
    if (layout) vkDestroyDescriptorSetLayout(device_, layout, nullptr);
}

Samplers::~Samplers() {
  for (const auto& entry : samplers_) vkDestroySampler(device_.handle(), entry.second, nullptr);
}

VkSampler Samplers::get(const SamplerDesc& desc) {
  for (const auto& [known, sampler] : samplers_)
    if (known == desc) return sampler;
  VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
  info.magFilter = info.minFilter = desc.filter;
  info.mipmapMode = desc.mipmaps ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
  info.addressModeU = desc.wrapU;
  info.addressModeV = info.addressModeW = desc.wrapV;
  info.maxLod = desc.mipmaps ? VK_LOD_CLAMP_NONE : 0.0f;
  if (desc.onlyLevel >= 0) {
    info.minLod = info.maxLod = desc.onlyLevel;
    info.mipmapMode = VK_SAMPLER_MIPMAP_MODE_NEAREST;
  }
  info.compareEnable = desc.compareLess;
  info.compareOp = VK_COMPARE_OP_LESS_OR_EQUAL;
  info.borderColor = VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE;
  VkSampler sampler;
  SCUMBLE_VK(vkCreateSampler(device_.handle(), &info, nullptr, &sampler));
  samplers_.emplace_back(desc, sampler);
  return sampler;
}

}  // namespace scumble::gpu
