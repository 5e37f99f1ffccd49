#include "frame/tile_flags.h"

#include "shaders/tiles_vert.h"

namespace scumble::frame {

void TileFlags::declare(FrameBuilder& frame, gpu::Handle tiles, bool byCompute) {
  tiles_ = tiles;
  byCompute_ = byCompute;
  frame.use(tiles, byCompute ? gpu::Use::sampledByCompute : gpu::Use::sampledByVertex);
}

void TileFlags::create(FrameBuilder& frame) {
  samplers_ = &frame.samplers();
  const VkShaderStageFlags stage = byCompute_ ? VK_SHADER_STAGE_COMPUTE_BIT : VK_SHADER_STAGE_VERTEX_BIT;
  layout_ = gpu::SetLayout(frame.device(), {{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, stage}});
  set_ = gpu::DescriptorSets(frame.device(), layout_);
}

void TileFlags::bind(const gpu::GraphResources& resources) {
  const gpu::Image& image = resources.image(tiles_);
  set_.rewriteTexture(0, 0, image.view(), samplers_->get({VK_FILTER_NEAREST}));
  count_ = {image.desc().width, image.desc().height};
}

shared::TileRule TileFlags::rule(TileChoice where, uint32_t firstView, glm::uvec2 size,
                                 glm::uvec2 over) const {
  const glm::vec2 pixels(over);
  return {int(firstView),
          where.mask,
          where.value,
          int(count_.x),
          2.0f * float(shared::kTileSize) / (pixels * glm::vec2(size)),
          pixels};
}

gpu::Handle TileMask::declare(FrameBuilder& frame, const std::string& step, const std::string& image,
                              TileChoice left) {
  left_ = left;
  views_ = frame.configuration().views();
  frame.step(step, [this](VkCommandBuffer commands) { record(commands); });
  flags_.declare(frame, frame.get(kTiles), false);
  depth_ = frame.use(frame.image(image, {.format = kDepthFormat}), gpu::Use::depthTarget);
  return depth_;
}

void TileMask::create(FrameBuilder& frame) {
  flags_.create(frame);
  gpu::GraphicsPipelineDesc desc;
  desc.vertex = {shaders::tiles_vert};
  desc.depthFormat = kDepthFormat;
  desc.viewMask = views_.mask();
  desc.pushConstantBytes = sizeof(shared::TileRule);
  // tiles.vert reads set 2 alone; what stands for the others is never bound.
  desc.sets = {frame.frameLayout().handle(), frame.frameLayout().handle(), flags_.layout().handle()};
  pipeline_ = gpu::Pipeline(frame.device(), desc);
}

void TileMask::bind(const gpu::GraphResources& resources) {
  resources_ = &resources;
  flags_.bind(resources);
}

void TileMask::record(VkCommandBuffer commands) const {
  const gpu::Target depth{&resources_->image(depth_), nullptr, {}};
  const glm::uvec2 size(depth.image->desc().width, depth.image->desc().height);
  gpu::drawViews(commands, views_, {}, &depth, [&](uint32_t firstView) {
    if (isWhole_) return;
    pipeline_.bind(commands);
    pipeline_.bindSet(commands, 2, flags_.set());
    pipeline_.pushAll(commands, flags_.rule(left_, firstView, size, {1, 1}));
    vkCmdDraw(commands, flags_.vertexCount(), 1, 0, 0);
  });
}

}  // namespace scumble::frame
