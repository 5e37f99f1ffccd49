#include "frame/pass.h"

#include <algorithm>
#include <cassert>

namespace scumble::frame {

UniformSlice UniformMemory::slice(uint64_t bytes) {
  constexpr uint64_t kBlock = 64 << 10;
  bytes = std::max<uint64_t>(bytes, 1);
  if (blocks_.empty() || used_ + bytes > blocks_.back().size()) {
    blocks_.push_back(
        gpu::PerFrameBuffer(device_, std::max(bytes, kBlock),
                            VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT));
    used_ = 0;
  }
  gpu::PerFrameBuffer& block = blocks_.back();
  const UniformSlice slice{block.handle(), used_, bytes, block.contents() + used_};
  used_ += gpu::uniformStride(bytes);
  return slice;
}

void UniformMemory::addUploads(std::vector<gpu::PerFrameBuffer*>& uploads) {
  for (gpu::PerFrameBuffer& block : blocks_) {
    block.markWritten();  // slices are, at any time
    uploads.push_back(&block);
  }
}

void UniformMemory::amend(const UniformSlice& slice, uint32_t frame) {
  for (gpu::PerFrameBuffer& block : blocks_)
    if (block.handle() == slice.buffer) block.amend(frame, slice.offset, slice.size);
}

FrameBuilder::FrameBuilder(gpu::Device& device, gpu::Samplers& samplers, ExampleTextures& examples,
                           const Configuration& configuration, const SceneOnGpu& scene,
                           const gpu::SetLayout& frameLayout, VkDescriptorSet frameSet,
                           UniformMemory& uniforms, std::vector<std::string> asked)
    : device_(device),
      samplers_(samplers),
      examples_(examples),
      configuration_(configuration),
      scene_(scene),
      frameLayout_(frameLayout),
      frameSet_(frameSet),
      uniforms_(uniforms),
      asked_(std::move(asked)) {
  // What has not moved keeps the vertices that an earlier frame wrote.
  give(kVertices, graph_.importBuffer(kVertices.name));
  give(kPreviousVertices, graph_.importBuffer(kPreviousVertices.name));
}

const FrameBuilder::Given* FrameBuilder::find(const Role& role, Layer layer) const {
  for (const Given& given : given_)
    if (given.role == &role && given.layer == layer) return &given;
  return nullptr;
}

gpu::Handle FrameBuilder::get(const Role& role, Layer layer) const {
  const Given* const given = find(role, layer);
  assert(given && "no pass before has given this role");
  return given->handle;
}

bool FrameBuilder::has(const Role& role, Layer layer) const {
  return find(role, layer) != nullptr;
}

bool FrameBuilder::isAsked(const Aov& aov) const {
  return std::find(asked_.begin(), asked_.end(), aov.name) != asked_.end();
}

void FrameBuilder::give(const Role& role, gpu::Handle handle, Layer layer) {
  if (const Given* const given = find(role, layer))
    given_[size_t(given - given_.data())].handle = handle;
  else
    given_.push_back({&role, layer, handle});
}

void FrameBuilder::step(const std::string& name, Record record) {
  graph_.addStep(name);
  records_.push_back(std::move(record));
  fetches_.emplace_back();
  declarers_.push_back(declaring_);
}

uint64_t FrameBuilder::fetchesOf(size_t step, const gpu::ImageShape::Frame& frame) const {
  const Fetches& fetches = fetches_[step];
  if (fetches.perTexel == 0) return 0;
  const gpu::ImageDesc desc = shape(fetches.image).at(frame);
  return uint64_t(desc.width) * desc.height * desc.layers * fetches.perTexel;
}

void FrameBuilder::offer(const Aov& aov, std::vector<gpu::Handle> images) {
  offers_.push_back({&aov, std::move(images)});
}

void FrameBuilder::declare(Pass& pass, uint32_t variant) {
  declaring_ = &pass;
  pass.declare(*this, variant);
  declaring_ = nullptr;
}

const FrameBuilder::Offer* FrameBuilder::offered(const std::string& name) const {
  for (const Offer& offer : offers_)
    if (name == offer.aov->name) return &offer;
  return nullptr;
}

bool FrameBuilder::needs(const Pass& pass, const gpu::FrameGraph::Needs& needs) const {
  for (size_t s = 0; s < declarers_.size(); ++s)
    if (declarers_[s] == &pass && needs.steps[s]) return true;
  return false;
}

}  // namespace scumble::frame
