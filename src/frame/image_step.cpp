#include "frame/image_step.h"

#include <algorithm>
#include <cassert>

#include "shaders/fullscreen_vert.h"
#include "shaders/tiles_vert.h"

namespace scumble::frame {

std::vector<gpu::Handle> ImageStep::declare(FrameBuilder& frame, ImageStepDesc desc) {
  desc_ = std::move(desc);
  uniformStride_ = gpu::uniformStride(std::max<uint64_t>(desc_.uniformBytes, 1));
  configuration_ = frame.configuration();
  compute_ = configuration_.computeImagePasses;
  frame.step(desc_.name, [this](VkCommandBuffer commands) { record(commands); });
  frame.countFetches(desc_.outputs[0], desc_.fetches);
  std::vector<gpu::Handle> read;
  for (const ImageStepDesc::Input& input : desc_.inputs) {
    if (std::find(read.begin(), read.end(), input.image) != read.end()) continue;
    frame.use(input.image, compute_ ? gpu::Use::sampledByCompute : gpu::Use::sampledByFragment);
    read.push_back(input.image);
  }
  if (desc_.tiles) tiles_.declare(frame, desc_.tiles, compute_);
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
  if (tiles_) tiles_.create(frame);
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
  if (tiles_) tiles_.bind(resources);
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
    assert((tiles_ || !jobs[job].where.mask) && "which tiles?");
    assert(!(jobs[job].where.value & ~jobs[job].where.mask) && "no tile is like that");
    jobs_.push_back({&pipelineFor(jobs[job]), jobs[job].where});
  }
}

const gpu::Pipeline& ImageStep::pipelineFor(const Job& job) {
  const bool onTiles = job.where.mask != 0;
  gpu::Pipeline& pipeline = pipelines_[{job.constants, onTiles && !compute_}];
  if (pipeline) return pipeline;
  // Constant 3 is every shader's number of views (src/shading/frame.glsl), 4 of on_screen.glsl.
  std::vector<uint32_t> all = job.constants;
  all.resize(3);
  all.push_back(configuration_.viewCount);
  all.push_back(configuration_.onSphere);
  if (compute_) {
    gpu::ComputePipelineDesc desc;
    desc.shader = desc_.shader.compute;
    desc.constants = std::move(all);
    desc.sets = {frame_->frameLayout().handle(), inputLayout_.handle(), outputLayout_.handle()};
    if (tiles_) {
      desc.sets.push_back(tiles_.layout().handle());
      desc.pushConstantBytes = sizeof(shared::TileRule);
    }
    pipeline = gpu::Pipeline(frame_->device(), desc);
  } else {
    gpu::GraphicsPipelineDesc desc;
    desc.vertex = onTiles ? gpu::Shader{shaders::tiles_vert} : gpu::Shader{shaders::fullscreen_vert};
    desc.fragment = desc_.shader.fragment;
    desc.constants = std::move(all);
    for (const gpu::Handle output : desc_.outputs) desc.colorFormats.push_back(frame_->shape(output).format);
    desc.viewMask = configuration_.views().mask();
    desc.pushConstantBytes = onTiles ? sizeof(shared::TileRule) : 4;
    desc.sets = {frame_->frameLayout().handle(), inputLayout_.handle()};
    if (onTiles) desc.sets.push_back(tiles_.layout().handle());
    pipeline = gpu::Pipeline(frame_->device(), desc);
  }
  return pipeline;
}

void ImageStep::record(VkCommandBuffer commands) const {
  const gpu::Image& first = resources_->image(desc_.outputs.front());
  const glm::uvec2 size(first.desc().width, first.desc().height);
  const gpu::ImageShape& shape = frame_->shape(desc_.outputs.front());
  const auto bind = [&](size_t job) {
    jobs_[job].pipeline->bind(commands);
    jobs_[job].pipeline->bindSet(commands, 0, frame_->frameSet());
    jobs_[job].pipeline->bindSet(commands, 1, inputSets_[job]);
  };
  const auto bindTiles = [&](size_t job, uint32_t set, uint32_t firstView) {
    jobs_[job].pipeline->bindSet(commands, set, tiles_.set());
    jobs_[job].pipeline->pushAll(commands,
                                 tiles_.rule(jobs_[job].where, firstView, size, {shape.overX, shape.overY}));
  };
  if (compute_) {
    // Jobs write different pixels, so that nothing need wait between them.
    for (size_t job = 0; job < jobs_.size(); ++job) {
      bind(job);
      jobs_[job].pipeline->bindSet(commands, 2, outputSet_[0]);
      if (tiles_) bindTiles(job, 3, 0);
      vkCmdDispatch(commands, (size.x + 7) / 8, (size.y + 7) / 8, first.desc().layers);
    }
    return;
  }
  std::vector<gpu::Target> targets;
  for (const gpu::Handle output : desc_.outputs)
    targets.push_back({&resources_->image(output), nullptr, {}, gpu::Target::Before::undefined});
  gpu::drawViews(commands, configuration_.views(), targets, nullptr, [&](uint32_t firstView) {
    for (size_t job = 0; job < jobs_.size(); ++job) {
      bind(job);
      if (jobs_[job].where.mask) {
        bindTiles(job, 2, firstView);
        vkCmdDraw(commands, tiles_.vertexCount(), 1, 0, 0);
      } else {
        jobs_[job].pipeline->push(commands, firstView);
        vkCmdDraw(commands, 3, 1, 0, 0);
      }
    }
  });
}

}  // namespace scumble::frame
