#include "frame/image_step.h"

#include <algorithm>
#include <cassert>

#include "shaders/fullscreen_vert.h"

namespace scumble::frame {

void ImageStep::declare(FrameBuilder& frame, const std::string& name, ImageShader shader,
                        std::vector<Input> inputs, const Outputs& outputs, uint64_t uniformBytes,
                        std::vector<uint32_t> constants, uint32_t textureCount, uint32_t maxJobs) {
  shader_ = shader;
  inputs_ = std::move(inputs);
  outputs_ = outputs.images;
  constants_ = std::move(constants);
  textureCount_ = textureCount;
  maxJobs_ = maxJobs;
  // No device wants uniforms at larger steps than this.
  uniformStride_ = (std::max<uint64_t>(uniformBytes, 16) + 255) / 256 * 256;
  uniforms_ = frame.uniform(uniformStride_ * maxJobs);
  compute_ = frame.configuration().computeImagePasses;
  configuration_ = frame.configuration();
  std::vector<gpu::ResourceUse> uses;
  for (const Input& input : inputs_) {
    const auto isKnown = [&](const gpu::ResourceUse& use) { return use.resource == input.image; };
    if (std::none_of(uses.begin(), uses.end(), isKnown))
      uses.push_back({input.image, compute_ ? gpu::Use::sampledByCompute : gpu::Use::sampledByFragment});
  }
  for (const gpu::ResourceId output : outputs_)
    uses.push_back({output, compute_ ? gpu::Use::storageImageWrite : gpu::Use::colorTarget});
  frame.addStep(name, std::move(uses), [this](VkCommandBuffer commands) { record(commands); });
}

void ImageStep::create(FrameBuilder& frame, const FrameResources& resources) {
  frame_ = &frame;
  resources_ = &resources;
  gpu::Device& device = frame.device();
  const VkShaderStageFlags stage = compute_ ? VK_SHADER_STAGE_COMPUTE_BIT : VK_SHADER_STAGE_FRAGMENT_BIT;
  std::vector<gpu::Binding> bindings{{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, stage}};
  bindings.resize(1 + inputs_.size() + textureCount_, {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, stage});
  inputLayout_ = gpu::SetLayout(device, bindings);
  inputSets_ = gpu::DescriptorSets(device, inputLayout_, maxJobs_);
  for (uint32_t job = 0; job < maxJobs_; ++job) {
    inputSets_.writeBuffer(job, 0, uniforms_.buffer, uniforms_.offset + job * uniformStride_, uniformStride_);
    for (uint32_t i = 0; i < inputs_.size(); ++i) {
      gpu::SamplerDesc sampler;
      if (!inputs_[i].linear) sampler.filter = VK_FILTER_NEAREST;
      inputSets_.writeTexture(job, 1 + i, resources.image(inputs_[i].image).view(),
                              frame.samplers().get(sampler));
    }
  }
  if (compute_) {
    const std::vector<gpu::Binding> written(outputs_.size(), {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, stage});
    outputLayout_ = gpu::SetLayout(device, written);
    outputSet_ = gpu::DescriptorSets(device, outputLayout_);
    for (uint32_t i = 0; i < outputs_.size(); ++i)
      outputSet_.writeStorageImage(0, i, resources.image(outputs_[i]).view());
  }
  if (textureCount_ == 0) setJobs({{constants_, {}}});
}

void ImageStep::setJobs(std::vector<Job> jobs) {
  assert(jobs.size() <= maxJobs_);
  jobs_.clear();
  for (size_t job = 0; job < jobs.size(); ++job) {
    assert(jobs[job].textures.size() == textureCount_);
    for (uint32_t i = 0; i < textureCount_; ++i) {
      const Texture& texture = jobs[job].textures[i];
      inputSets_.writeTexture(job, uint32_t(1 + inputs_.size() + i), texture.image->view(),
                              frame_->samplers().get(texture.sampler));
    }
    jobs_.push_back(&pipelineFor(jobs[job].constants));
  }
}

const gpu::Pipeline& ImageStep::pipelineFor(const std::vector<uint32_t>& constants) {
  gpu::Pipeline& pipeline = pipelines_[constants];
  if (pipeline) return pipeline;
  // Constant 3 is every shader's number of views (src/shading/frame.glsl).
  std::vector<uint32_t> all = constants;
  all.resize(3);
  all.push_back(configuration_.viewCount);
  if (compute_) {
    gpu::ComputePipelineDesc desc;
    desc.shader = shader_.compute;
    desc.constants = std::move(all);
    desc.sets = {resources_->frameLayout().handle(), inputLayout_.handle(), outputLayout_.handle()};
    pipeline = gpu::Pipeline(frame_->device(), desc);
  } else {
    gpu::GraphicsPipelineDesc desc;
    desc.vertex = {shaders::fullscreen_vert};
    desc.fragment = shader_.fragment;
    desc.constants = std::move(all);
    for (const gpu::ResourceId output : outputs_)
      desc.colorFormats.push_back(resources_->image(output).desc().format);
    desc.viewMask = configuration_.views().mask();
    desc.pushConstantBytes = 4;
    desc.sets = {resources_->frameLayout().handle(), inputLayout_.handle()};
    pipeline = gpu::Pipeline(frame_->device(), desc);
  }
  return pipeline;
}

void ImageStep::record(VkCommandBuffer commands) const {
  const gpu::Image& output = resources_->image(outputs_.front());
  const uint32_t width = output.desc().width, height = output.desc().height;
  const auto bind = [&](size_t job) {
    jobs_[job]->bind(commands);
    jobs_[job]->bindSet(commands, 0, resources_->frameSet());
    jobs_[job]->bindSet(commands, 1, inputSets_[job]);
  };
  if (compute_) {
    // Jobs write different pixels, so that nothing need wait between them.
    for (size_t job = 0; job < jobs_.size(); ++job) {
      bind(job);
      jobs_[job]->bindSet(commands, 2, outputSet_[0]);
      vkCmdDispatch(commands, (width + 7) / 8, (height + 7) / 8, output.desc().layers);
    }
    return;
  }
  std::vector<gpu::Target> targets;
  for (const gpu::ResourceId id : outputs_)
    targets.push_back({&resources_->image(id), nullptr, {}, gpu::Target::Before::undefined});
  gpu::drawViews(commands, configuration_.views(), targets, nullptr, [&](uint32_t firstView) {
    for (size_t job = 0; job < jobs_.size(); ++job) {
      bind(job);
      jobs_[job]->push(commands, firstView);
      vkCmdDraw(commands, 3, 1, 0, 0);
    }
  });
}

}  // namespace scumble::frame
