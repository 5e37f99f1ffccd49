#include "frame/image_step.h"

#include <algorithm>
#include <cassert>

#include "shaders/fullscreen_vert.h"

namespace scumble::frame {

std::vector<gpu::Handle> ImageStep::declare(FrameBuilder& frame, ImageStepDesc desc) {
  desc_ = std::move(desc);
  uniformStride_ = gpu::uniformStride(std::max<uint64_t>(desc_.uniformBytes, 1));
  configuration_ = frame.configuration();
  compute_ = configuration_.computeImagePasses;
  frame.step(desc_.name, [this](VkCommandBuffer commands) { record(commands); });
  std::vector<gpu::Handle> read;
  for (const ImageStepDesc::Input& input : desc_.inputs) {
    if (std::find(read.begin(), read.end(), input.image) != read.end()) continue;
    frame.use(input.image, compute_ ? gpu::Use::sampledByCompute : gpu::Use::sampledByFragment);
    read.push_back(input.image);
  }
  for (gpu::Handle& output : desc_.outputs)
    output = frame.use(output, compute_ ? gpu::Use::storageImageWrite : gpu::Use::colorTarget);
  return desc_.outputs;
}

void ImageStep::create(FrameBuilder& frame) {
  frame_ = &frame;
  gpu::Device& device = frame.device();
  uniforms_ = frame.uniform(uniformStride_ * desc_.maxJobs);
  const VkShaderStageFlags stage = compute_ ? VK_SHADER_STAGE_COMPUTE_BIT : VK_SHADER_STAGE_FRAGMENT_BIT;
  // Whatever its number, each binding has one user.
  std::vector<gpu::Binding> bindings{{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, stage}};
  bindings.resize(1 + desc_.inputs.size() + desc_.textures.size(),
                  {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, stage});
  std::vector<bool> isUsed(bindings.size());
  const auto take = [&](uint32_t binding) {
    assert(binding > 0 && binding < bindings.size() && !isUsed[binding] && "bindings are 1, 2, 3 ...");
    isUsed[binding] = true;
  };
  for (const ImageStepDesc::Input& input : desc_.inputs) take(input.binding);
  for (const uint32_t texture : desc_.textures) take(texture);
  inputLayout_ = gpu::SetLayout(device, bindings);
  inputSets_ = gpu::DescriptorSets(device, inputLayout_, desc_.maxJobs);
  for (uint32_t job = 0; job < desc_.maxJobs; ++job)
    inputSets_.writeBuffer(job, 0, uniforms_.buffer, uniforms_.offset + job * uniformStride_, uniformStride_);
  if (compute_) {
    const std::vector<gpu::Binding> written(desc_.outputs.size(), {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, stage});
    outputLayout_ = gpu::SetLayout(device, written);
    outputSet_ = gpu::DescriptorSets(device, outputLayout_);
  }
  if (desc_.textures.empty()) setJobs({{desc_.constants, {}}});
}

void ImageStep::bind(const gpu::GraphResources& resources) {
  resources_ = &resources;
  for (const ImageStepDesc::Input& input : desc_.inputs) {
    gpu::SamplerDesc sampler;
    if (!input.linear) sampler.filter = VK_FILTER_NEAREST;
    for (uint32_t job = 0; job < desc_.maxJobs; ++job)
      inputSets_.rewriteTexture(job, input.binding, resources.image(input.image).view(),
                                frame_->samplers().get(sampler));
  }
  if (compute_)
    for (uint32_t i = 0; i < desc_.outputs.size(); ++i)
      outputSet_.writeStorageImage(0, i, resources.image(desc_.outputs[i]).view());
}

void ImageStep::setJobs(const std::vector<Job>& jobs) {
  assert(jobs.size() <= desc_.maxJobs);
  jobs_.clear();
  for (size_t job = 0; job < jobs.size(); ++job) {
    assert(jobs[job].textures.size() == desc_.textures.size());
    for (const Texture& texture : jobs[job].textures)
      inputSets_.writeTexture(job, texture.binding, texture.image->view(),
                              frame_->samplers().get(texture.sampler));
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
    desc.shader = desc_.shader.compute;
    desc.constants = std::move(all);
    desc.sets = {frame_->frameLayout().handle(), inputLayout_.handle(), outputLayout_.handle()};
    pipeline = gpu::Pipeline(frame_->device(), desc);
  } else {
    gpu::GraphicsPipelineDesc desc;
    desc.vertex = {shaders::fullscreen_vert};
    desc.fragment = desc_.shader.fragment;
    desc.constants = std::move(all);
    for (const gpu::Handle output : desc_.outputs) desc.colorFormats.push_back(frame_->shape(output).format);
    desc.viewMask = configuration_.views().mask();
    desc.pushConstantBytes = 4;
    desc.sets = {frame_->frameLayout().handle(), inputLayout_.handle()};
    pipeline = gpu::Pipeline(frame_->device(), desc);
  }
  return pipeline;
}

void ImageStep::record(VkCommandBuffer commands) const {
  const gpu::Image& first = resources_->image(desc_.outputs.front());
  const uint32_t width = first.desc().width, height = first.desc().height;
  const auto bind = [&](size_t job) {
    jobs_[job]->bind(commands);
    jobs_[job]->bindSet(commands, 0, frame_->frameSet());
    jobs_[job]->bindSet(commands, 1, inputSets_[job]);
  };
  if (compute_) {
    // Jobs write different pixels, so that nothing need wait between them.
    for (size_t job = 0; job < jobs_.size(); ++job) {
      bind(job);
      jobs_[job]->bindSet(commands, 2, outputSet_[0]);
      vkCmdDispatch(commands, (width + 7) / 8, (height + 7) / 8, first.desc().layers);
    }
    return;
  }
  std::vector<gpu::Target> targets;
  for (const gpu::Handle output : desc_.outputs)
    targets.push_back({&resources_->image(output), nullptr, {}, gpu::Target::Before::undefined});
  gpu::drawViews(commands, configuration_.views(), targets, nullptr, [&](uint32_t firstView) {
    for (size_t job = 0; job < jobs_.size(); ++job) {
      bind(job);
      jobs_[job]->push(commands, firstView);
      vkCmdDraw(commands, 3, 1, 0, 0);
    }
  });
}

}  // namespace scumble::frame
