#include "features/ink/lines/line_finder.h"

#include <algorithm>

#include "features/ink/ink.h"
#include "features/ink/lines/ink_moment.h"
#include "gpu/dispatch.h"
#include "shaders/ink_find_comp.h"
#include "shaders/ink_list_comp.h"
#include "shaders/ink_record_comp.h"
#include "shading/geometry_constants.shared.h"

namespace scumble::ink {

static_assert(shared::kInkWordsOfChunk == shared::kInkThreads, "shaders go through words and bits alike");

const EdgesOnGpu* LineFinder::edges() const {
  const auto here = frame_->scene().feature(kName);
  return here ? &static_cast<const InkMoment*>(here->moment)->edges() : nullptr;
}

void LineFinder::create(frame::FrameBuilder& frame, const frame::UniformSlice& uniforms,
                        const frame::UniformSlice& lines) {
  frame_ = &frame;
  std::vector<gpu::Binding> bindings(
      shared::kInkBindings,
      {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_COMPUTE_BIT | VK_SHADER_STAGE_VERTEX_BIT});
  bindings[shared::kInkBlock].type = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
  bindings[shared::kInkBlock].stages |= VK_SHADER_STAGE_FRAGMENT_BIT;
  layout_ = gpu::SetLayout(frame.device(), std::move(bindings));
  set_ = gpu::DescriptorSets(frame.device(), layout_);
  set_.writeBuffer(0, shared::kInkBlock, uniforms.buffer, uniforms.offset, uniforms.size);
  set_.writeBuffer(0, shared::kInkLines, lines.buffer, lines.offset, lines.size);
  recordsOfLines_ =
      gpu::Buffer(frame.device(),
                  uint64_t(shared::kInkRoom) * frame.configuration().viewCount * sizeof(shared::LineRecord),
                  VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::MemoryKind::device);
  set_.writeBuffer(0, shared::kInkRecords, recordsOfLines_.handle());
  command_ = gpu::Buffer(frame.device(), sizeof(shared::InkCommand),
                         VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
                             VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                         gpu::MemoryKind::device);
  set_.writeBuffer(0, shared::kInkCommand, command_.handle());
}

std::vector<uint32_t> LineFinder::constants(uint32_t choices) const {
  std::vector<uint32_t> all(size_t(shared::kPassId) + 1);
  all[size_t(shared::kViewCountId)] = frame_->configuration().viewCount;
  all[size_t(shared::kPassId)] = choices;
  return all;
}

void LineFinder::specialise(uint32_t choices) {
  choices_ = choices;
  Pipelines& pipelines = pipelines_[choices];
  if (pipelines.find) return;
  gpu::ComputePipelineDesc desc;
  desc.sets = {frame_->frameLayout().handle(), layout_.handle()};
  desc.pushConstantBytes = 4;
  desc.constants = constants(choices);
  desc.shader = {shaders::ink_find_comp};
  pipelines.find = gpu::Pipeline(frame_->device(), desc);
  desc.shader = {shaders::ink_record_comp};
  pipelines.record = gpu::Pipeline(frame_->device(), desc);
  if (list_) return;
  desc.constants.clear();
  desc.shader = {shaders::ink_list_comp};
  list_ = gpu::Pipeline(frame_->device(), desc);
}

void LineFinder::bind() {
  if (isEmpty()) return;
  const auto make = [&](uint64_t numbers) {
    return gpu::Buffer(frame_->device(), numbers * sizeof(uint32_t),
                       VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                       gpu::MemoryKind::device);
  };
  const uint64_t lines = std::max<uint64_t>(1, edges()->edgeCount());  // at most
  if (numbers_.size() < lines * sizeof(uint32_t)) {
    numbers_ = make(lines);
    set_.writeBuffer(0, shared::kInkNumbers, numbers_.handle());
  }
  const uint32_t chunks = edges()->chunkCount();
  if (chunks_ < chunks) {
    chunks_ = chunks;
    const uint32_t words = chunks * uint32_t(shared::kInkWordsOfChunk);
    words_ = make(words);
    sums_ = make(words + 1);
    sum_ = gpu::PrefixSum(frame_->device(), sums_, words + 1);
    set_.writeBuffer(0, shared::kInkWords, words_.handle());
    set_.writeBuffer(0, shared::kInkSums, sums_.handle());
  }
  set_.writeBuffer(0, shared::kInkBounds, edges()->bounds().handle());
  set_.writeBuffer(0, shared::kInkChunks, edges()->chunks().handle());
  const GeometryOnGpu& geometry = frame_->scene().geometry();
  addresses_ = {edges()->edges().address(), edges()->rings().address(), geometry.finalCore().address(),
                geometry.finalFrame().address(), geometry.restCore().address()};
}

void LineFinder::record(VkCommandBuffer commands) const {
  if (isEmpty()) return;
  const uint32_t chunks = edges()->chunkCount();
  const auto run = [&](const gpu::Pipeline& pipeline) {
    gpu::computeBarrier(commands);
    pipeline.bind(commands);
    pipeline.bindSet(commands, 0, frame_->frameSet());
    pipeline.bindSet(commands, 1, set_[0]);
    pipeline.push(commands, chunks);
    gpu::dispatch(commands, chunks);
  };
  const Pipelines& pipelines = pipelines_.at(choices_);
  run(pipelines.find);
  sum_.record(commands, chunks * uint32_t(shared::kInkWordsOfChunk) + 1);
  run(list_);
  // How each of them looks.
  gpu::indirectBarrier(commands);
  pipelines.record.bind(commands);
  pipelines.record.bindSet(commands, 0, frame_->frameSet());
  pipelines.record.bindSet(commands, 1, set_[0]);
  vkCmdDispatchIndirect(commands, command_.handle(), offsetof(shared::InkCommand, groupsX));
}

}  // namespace scumble::ink
