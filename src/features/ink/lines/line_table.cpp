#include "features/ink/lines/line_table.h"

#include "shaders/ink_table_comp.h"

namespace scumble::ink {

void LineTable::declare(frame::FrameBuilder& frame, gpu::Handle numbers, gpu::Handle command) {
  constexpr uint32_t kHeight = uint32_t(shared::kLineTableRows * shared::kLineTexels) + 1;
  const gpu::Handle empty = frame.image(
      "ink table", {.format = frame::kFloats, .width = uint32_t(shared::kLineTableWidth), .height = kHeight});
  frame.step("ink-table", [this](VkCommandBuffer commands) { clear(commands); });
  image_ = frame.use(empty, gpu::Use::copyTarget);
  frame.step("ink-table", [this](VkCommandBuffer commands) { record(commands); });
  frame.use(frame.get(frame::kVertices), gpu::Use::storageBufferRead);
  frame.use(numbers, gpu::Use::storageBufferRead);
  frame.use(command, gpu::Use::storageBufferRead);
  image_ = frame.use(image_, gpu::Use::storageImageWrite);
}

void LineTable::create(frame::FrameBuilder& frame, const LineFinder& finder) {
  frame_ = &frame;
  finder_ = &finder;
  layout_ = gpu::SetLayout(frame.device(), {{VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, VK_SHADER_STAGE_COMPUTE_BIT}});
  set_ = gpu::DescriptorSets(frame.device(), layout_);
}

void LineTable::bind(const gpu::GraphResources& resources) {
  resources_ = &resources;
  set_.writeStorageImage(0, shared::kLineTableImage, resources.image(image_).view());
}

void LineTable::specialise(uint32_t choices) {
  choices_ = choices;
  gpu::Pipeline& pipeline = pipelines_[choices];
  if (pipeline) return;
  gpu::ComputePipelineDesc desc;
  desc.shader = {shaders::ink_table_comp};
  desc.sets = {frame_->frameLayout().handle(), finder_->layout().handle(), layout_.handle()};
  desc.constants = finder_->constants(choices);
  pipeline = gpu::Pipeline(frame_->device(), desc);
}

void LineTable::clear(VkCommandBuffer commands) const {
  const VkClearColorValue nothing{};
  const gpu::Image& image = resources_->image(image_);
  const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, image.desc().layers};
  vkCmdClearColorImage(commands, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &nothing, 1, &all);
}

void LineTable::record(VkCommandBuffer commands) const {
  if (finder_->isEmpty()) return;
  const gpu::Pipeline& pipeline = pipelines_.at(choices_);
  pipeline.bind(commands);
  pipeline.bindSet(commands, 0, frame_->frameSet());
  pipeline.bindSet(commands, 1, finder_->set());
  pipeline.bindSet(commands, 2, set_[0]);
  static_assert(shared::kLineTableRoom % shared::kInkThreads == 0);
  vkCmdDispatch(commands, uint32_t(shared::kLineTableRoom / shared::kInkThreads), 1,
                frame_->configuration().viewCount);
}

}  // namespace scumble::ink
