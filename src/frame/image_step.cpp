#include "frame/image_step.h"

#include <algorithm>

#include "shaders/fullscreen_vert.h"

namespace scumble::frame {

void ImageStep::declare(FrameBuilder& frame, const std::string& name, ImageShader shader,
                        std::vector<Input> inputs, gpu::ResourceId output, uint64_t uniformBytes,
                        std::vector<Texture> textures, std::vector<uint32_t> constants) {
  shader_ = shader;
  inputs_ = std::move(inputs);
  output_ = output;
  textures_ = std::move(textures);
  // Constant 3 is every shader's number of views (src/shading/frame.glsl).
  constants_ = std::move(constants);
  constants_.resize(3);
  constants_.push_back(frame.configuration().viewCount);
  uniforms_ = frame.uniform(std::max<uint64_t>(uniformBytes, 16));
  compute_ = frame.configuration().computeImagePasses;
  configuration_ = frame.configuration();
  std::vector<gpu::ResourceUse> uses;
  for (const Input& input : inputs_)
    uses.push_back({input.image, compute_ ? gpu::Use::sampledByCompute : gpu::Use::sampledByFragment});
  uses.push_back({output, compute_ ? gpu::Use::storageImageWrite : gpu::Use::colorTarget});
  frame.addStep(name, std::move(uses), [this](VkCommandBuffer commands) { record(commands); });
}

void ImageStep::create(FrameBuilder& frame, const FrameResources& resources) {
  resources_ = &resources;
  gpu::Device& device = frame.device();
  const VkShaderStageFlags stage = compute_ ? VK_SHADER_STAGE_COMPUTE_BIT : VK_SHADER_STAGE_FRAGMENT_BIT;
  std::vector<gpu::Binding> bindings{{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, stage}};
  bindings.resize(1 + inputs_.size() + textures_.size(), {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, stage});
  inputLayout_ = gpu::SetLayout(device, bindings);
  inputSet_ = gpu::DescriptorSets(device, inputLayout_);
  inputSet_.writeBuffer(0, 0, uniforms_.buffer, uniforms_.offset, uniforms_.size);
  for (uint32_t i = 0; i < inputs_.size(); ++i) {
    gpu::SamplerDesc sampler;
    if (!inputs_[i].linear) sampler.filter = VK_FILTER_NEAREST;
    inputSet_.writeTexture(0, 1 + i, resources.image(inputs_[i].image).view(), frame.samplers().get(sampler));
  }
  for (uint32_t i = 0; i < textures_.size(); ++i)
    inputSet_.writeTexture(0, uint32_t(1 + inputs_.size() + i), textures_[i].image->view(),
                           frame.samplers().get(textures_[i].sampler));
  const gpu::Image& output = resources.image(output_);
  if (compute_) {
    outputLayout_ = gpu::SetLayout(device, {{VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, stage}});
    outputSet_ = gpu::DescriptorSets(device, outputLayout_);
    outputSet_.writeStorageImage(0, 0, output.view());
    gpu::ComputePipelineDesc desc;
    desc.shader = shader_.compute;
    desc.constants = constants_;
    desc.sets = {resources.frameLayout().handle(), inputLayout_.handle(), outputLayout_.handle()};
    pipeline_ = gpu::Pipeline(device, desc);
  } else {
    gpu::GraphicsPipelineDesc desc;
    desc.vertex = {shaders::fullscreen_vert};
    desc.fragment = shader_.fragment;
    desc.constants = constants_;
    desc.colorFormats = {output.desc().format};
    desc.viewMask = viewMask(configuration_);
    desc.pushConstantBytes = 4;
    desc.sets = {resources.frameLayout().handle(), inputLayout_.handle()};
    pipeline_ = gpu::Pipeline(device, desc);
  }
}

void ImageStep::record(VkCommandBuffer commands) const {
  const gpu::Image& output = resources_->image(output_);
  const uint32_t width = output.desc().width, height = output.desc().height;
  const auto bind = [&] {
    pipeline_.bind(commands);
    pipeline_.bindSet(commands, 0, resources_->frameSet());
    pipeline_.bindSet(commands, 1, inputSet_[0]);
  };
  if (compute_) {
    bind();
    pipeline_.bindSet(commands, 2, outputSet_[0]);
    vkCmdDispatch(commands, (width + 7) / 8, (height + 7) / 8, output.desc().layers);
    return;
  }
  const Target target{&output, nullptr, {}, Target::Before::undefined};
  drawViews(commands, configuration_, {&target, 1}, nullptr, [&](uint32_t firstView) {
    bind();
    pipeline_.push(commands, firstView);
    vkCmdDraw(commands, 3, 1, 0, 0);
  });
}

}  // namespace scumble::frame
