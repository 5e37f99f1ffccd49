#include "frame/pass.h"

#include <algorithm>
#include <cassert>

namespace scumble::frame {

FrameBuilder::FrameBuilder(gpu::Device& device, gpu::Samplers& samplers, ExampleTextures& examples,
                           const Configuration& configuration, const SceneOnGpu& scene,
                           UniformSlice uniformMemory)
    : device_(device),
      samplers_(samplers),
      examples_(examples),
      configuration_(configuration),
      scene_(scene),
      uniformMemory_(uniformMemory),
      slots_(size_t(Slot::count), kNone),
      multisampled_(size_t(Slot::count), kNone),
      finalVertices_(graph_.addBuffer("final vertices")) {}

gpu::ResourceId FrameBuilder::slot(Slot slot) {
  gpu::ResourceId& id = slots_[size_t(slot)];
  if (id == kNone) {
    const SlotInfo& info = slotInfo(slot);
    gpu::ImageDesc desc{info.format, configuration_.width, configuration_.height, 1};
    if (slot == Slot::shadowMap) desc.width = desc.height = kShadowMapSize;
    if (slot == Slot::blur) desc.width = (desc.width + 3) / 4, desc.height = (desc.height + 3) / 4;
    if (info.rate == Rate::perView) desc.layers = configuration_.viewCount;
    id = graph_.addImage(info.name, desc);
  }
  return id;
}

gpu::ResourceId FrameBuilder::multisampled(Slot slot) {
  assert(slotInfo(slot).multisampled && configuration_.samples > 1);
  gpu::ResourceId& id = multisampled_[size_t(slot)];
  if (id == kNone) {
    const SlotInfo& info = slotInfo(slot);
    id = graph_.addImage(std::string(info.name) + " samples",
                         {info.format, configuration_.width, configuration_.height, configuration_.viewCount,
                          1, configuration_.samples});
  }
  return id;
}

void FrameBuilder::addStep(const std::string& name, std::vector<gpu::ResourceUse> uses, Record record) {
  graph_.addStep(name, std::move(uses));
  records_.push_back(std::move(record));
}

UniformSlice FrameBuilder::uniform(uint64_t bytes) {
  constexpr uint64_t kAlignment = 256;  // no device asks for more
  const UniformSlice slice{uniformMemory_.buffer, uniformMemory_.offset + uniformUsed_, bytes,
                           uniformMemory_.mapped + uniformUsed_};
  uniformUsed_ += (bytes + kAlignment - 1) / kAlignment * kAlignment;
  assert(uniformUsed_ <= uniformMemory_.size);
  return slice;
}

FrameResources::FrameResources(gpu::Device& device, const FrameBuilder& builder,
                               const gpu::SetLayout& frameLayout, VkDescriptorSet frameSet)
    : frameLayout_(frameLayout), frameSet_(frameSet) {
  for (const gpu::FrameGraph::ResourceInfo& resource : builder.graph().resources()) {
    if (resource.isImage && resource.usage != 0)
      images_.emplace_back(device, resource.desc, resource.usage);
    else
      images_.emplace_back();
  }
}

}  // namespace scumble::frame
