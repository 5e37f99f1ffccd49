#include "frame/vertex_input.h"

namespace scumble::frame {

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
      {2, VK_FORMAT_R32_SFLOAT, offsetof(VertexSurface, warpScale)},
      {3, VK_FORMAT_R32G32B32_SFLOAT, 0},
      {4, VK_FORMAT_R32_UINT, 0},
  };
  static constexpr uint32_t kStrides[] = {sizeof(VertexCore), sizeof(VertexFrame), sizeof(VertexSurface),
                                          sizeof(glm::vec3), sizeof(uint32_t)};
  bool used[std::size(kStrides)] = {};
  for (uint32_t location = 0; location < std::size(kAttributes); ++location) {
    if (!(inputs >> location & 1)) continue;
    const Attribute& a = kAttributes[location];
    pipeline.vertexAttributes.push_back({location, a.binding, a.format, a.offset});
    used[a.binding] = true;
  }
  for (uint32_t binding = 0; binding < std::size(kStrides); ++binding)
    if (used[binding])
      pipeline.vertexBindings.push_back({binding, kStrides[binding], VK_VERTEX_INPUT_RATE_VERTEX});
}

void bindVertices(VkCommandBuffer commands, const SceneOnGpu& scene) {
  const VkBuffer buffers[] = {scene.geometry().finalCore().handle(), scene.geometry().finalFrame().handle(),
                              scene.geometry().surface().handle(), scene.previousPositions().handle(),
                              scene.transparent().partOfVertex()};
  const VkDeviceSize offsets[std::size(buffers)] = {};
  vkCmdBindVertexBuffers(commands, 0, uint32_t(std::size(buffers)), buffers, offsets);
}

}  // namespace scumble::frame
