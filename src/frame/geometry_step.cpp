#include "frame/geometry_step.h"

#include <algorithm>

namespace scumble::frame {

namespace {

void addVertexInput(gpu::GraphicsPipelineDesc& pipeline, uint32_t inputs) {
  struct Attribute {
    uint32_t binding;
    VkFormat format;
    uint32_t offset;
  };
  using shared::VertexCore, shared::VertexFrame, shared::VertexSurface;
  static constexpr Attribute kAttributes[] = {
      {0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(VertexCore, position)},
      {0, VK_FORMAT_R16G16_SNORM, offsetof(VertexCore, normal)},
      {2, VK_FORMAT_R32G32_SFLOAT, offsetof(VertexSurface, uv0)},
      {2, VK_FORMAT_R32G32_SFLOAT, offsetof(VertexSurface, uv1)},
      {2, VK_FORMAT_R8G8B8A8_UNORM, offsetof(VertexSurface, color)},
      {1, VK_FORMAT_R32G32B32_SFLOAT, offsetof(VertexFrame, dPdu)},
      {1, VK_FORMAT_R16G16_SNORM, offsetof(VertexFrame, smoothNormal)},
      {1, VK_FORMAT_R32G32B32_SFLOAT, offsetof(VertexFrame, dPdv)},
      {2, VK_FORMAT_R32G32_SFLOAT, offsetof(VertexSurface, patternUv)},
  };
  static constexpr uint32_t kStrides[] = {sizeof(VertexCore), sizeof(VertexFrame), sizeof(VertexSurface)};
  bool used[3] = {};
  for (uint32_t location = 0; location < std::size(kAttributes); ++location) {
    if (!(inputs >> location & 1)) continue;
    const Attribute& a = kAttributes[location];
    pipeline.vertexAttributes.push_back({location, a.binding, a.format, a.offset});
    used[a.binding] = true;
  }
  for (uint32_t binding = 0; binding < 3; ++binding)
    if (used[binding])
      pipeline.vertexBindings.push_back({binding, kStrides[binding], VK_VERTEX_INPUT_RATE_VERTEX});
}

}  // namespace

void GeometryStep::create(gpu::Device& device, const FrameResources& resources, const SceneOnGpu& scene,
                          const GeometryStepDesc& desc) {
  hasPassSet_ = desc.passLayout != nullptr;
  hasViews_ = desc.viewMask != 0;
  materialStrides_ = desc.materialStrides;
  for (const Draw& draw : scene.draws()) {
    gpu::Pipeline& made = pipelines_[variant(draw)];
    if (made) continue;
    const bool depthOnly = draw.alpha == AlphaMode::opaque && !desc.depthOnlyVertex.words.empty();
    gpu::GraphicsPipelineDesc pipeline;
    pipeline.vertex = depthOnly ? desc.depthOnlyVertex : desc.vertex;
    if (!depthOnly) pipeline.fragment = desc.fragment;
    pipeline.constants = {uint32_t(draw.alpha), draw.varied, draw.textured, desc.viewCount};
    addVertexInput(pipeline, depthOnly ? uint32_t(kPosition) : desc.inputs);
    pipeline.colorFormats = desc.colorFormats;
    pipeline.depthFormat = VK_FORMAT_D32_SFLOAT;
    pipeline.depthCompare = desc.depthCompare;
    if (draw.alpha == AlphaMode::blend && desc.blends) {
      pipeline.blend = gpu::Blend::over;
      pipeline.depthWrite = false;
    }
    pipeline.samples = desc.samples;
    pipeline.viewMask = desc.viewMask;
    pipeline.pushConstantBytes = desc.viewMask ? 4 : 0;
    pipeline.dynamicCulling = true;
    pipeline.sets = {resources.frameLayout().handle(), scene.materialLayout().handle()};
    if (hasPassSet_) pipeline.sets.push_back(desc.passLayout->handle());
    made = gpu::Pipeline(device, pipeline);
  }
}

void GeometryStep::draw(VkCommandBuffer commands, const FrameResources& resources, const SceneOnGpu& scene,
                        VkDescriptorSet passSet, uint32_t firstView, const glm::vec3& eye,
                        const std::function<bool(const Draw&)>& includes) const {
  const VkBuffer buffers[] = {scene.finalCore().handle(), scene.finalFrame().handle(),
                              scene.surface().handle()};
  const VkDeviceSize offsets[] = {0, 0, 0};
  vkCmdBindVertexBuffers(commands, 0, 3, buffers, offsets);
  vkCmdBindIndexBuffer(commands, scene.indices().handle(), 0, VK_INDEX_TYPE_UINT32);

  // Opaque surfaces by pipeline and from near to far, so that what is hidden is not shaded; blended ones from
  // far to near.
  std::vector<const Draw*> order;
  for (const Draw& draw : scene.draws())
    if (!includes || includes(draw)) order.push_back(&draw);
  const auto distance = [&](const Draw& d) { return glm::length(d.bounds.center() - eye); };
  std::stable_sort(order.begin(), order.end(), [&](const Draw* a, const Draw* b) {
    if (a->alpha != b->alpha) return a->alpha < b->alpha;
    if (a->alpha == AlphaMode::blend) return distance(*a) > distance(*b);
    if (variant(*a) != variant(*b)) return variant(*a) < variant(*b);
    return distance(*a) < distance(*b);
  });

  const gpu::Pipeline* bound = nullptr;
  uint32_t boundMaterial = ~0u;
  int cull = -1, front = -1;
  std::vector<uint32_t> offsetsOfMaterial(materialStrides_.size());
  for (const Draw* draw : order) {
    const gpu::Pipeline& pipeline = pipelines_[variant(*draw)];
    if (bound != &pipeline) {
      pipeline.bind(commands);
      pipeline.bindSet(commands, 0, resources.frameSet());
      if (hasViews_) pipeline.push(commands, firstView);
      bound = &pipeline;
      boundMaterial = ~0u;
    }
    if (boundMaterial != draw->material) {
      pipeline.bindSet(commands, 1, scene.materialSet(draw->material));
      for (size_t i = 0; i < materialStrides_.size(); ++i)
        offsetsOfMaterial[i] = draw->material * materialStrides_[i];
      if (hasPassSet_) pipeline.bindSet(commands, 2, passSet, offsetsOfMaterial);
      boundMaterial = draw->material;
    }
    if (cull != int(draw->cullsBack))
      vkCmdSetCullMode(commands, draw->cullsBack ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE),
          cull = draw->cullsBack;
    if (front != int(draw->mirrored))
      vkCmdSetFrontFace(commands, draw->mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE),
          front = draw->mirrored;
    vkCmdDrawIndexed(commands, draw->indexCount, 1, draw->firstIndex, draw->vertexOffset, draw->object);
  }
}

}  // namespace scumble::frame
