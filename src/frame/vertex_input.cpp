#include "frame/vertex_input.h"

namespace scumble::frame {

void addVertexInput(gpu::GraphicsPipelineDesc& pipeline, uint32_t inputs) {
  struct Attribute {
    uint32_t binding;
    VkFormat format;
    uint32_t offset;
  };
  using shared::VertexCore, shared::VertexFrame, shared::VertexTint;
  static constexpr Attribute kAttributes[] = {
      {0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(VertexCore, position)},
      {0, VK_FORMAT_R16G16_SNORM, offsetof(VertexCore, normal)},
      {2, VK_FORMAT_R32G32_SFLOAT, 0},
      {3, VK_FORMAT_R32G32_SFLOAT, 0},
      {5, VK_FORMAT_R8G8B8A8_UNORM, offsetof(VertexTint, color)},
      {1, VK_FORMAT_R32G32B32_SFLOAT, offsetof(VertexFrame, dPdu)},
      {1, VK_FORMAT_R16G16_SNORM, offsetof(VertexFrame, smoothNormal)},
      {1, VK_FORMAT_R32G32B32_SFLOAT, offsetof(VertexFrame, dPdv)},
      {4, VK_FORMAT_R32G32_SFLOAT, 0},
      {5, VK_FORMAT_R32_SFLOAT, offsetof(VertexTint, warpScale)},
      {6, VK_FORMAT_R32G32B32_SFLOAT, 0},
      {7, VK_FORMAT_R32_UINT, 0},
      {8, VK_FORMAT_R8G8B8A8_UNORM, 0},
  };
  for (uint32_t location = 0; location < std::size(kAttributes); ++location)
    if (inputs >> location & 1) {
      const Attribute& a = kAttributes[location];
      pipeline.vertexAttributes.push_back({location, a.binding, a.format, a.offset});
    }
}

void bindVertices(VkCommandBuffer commands, const SceneOnGpu& scene) {
  const GeometryOnGpu& geometry = scene.geometry();
  const VkBuffer buffers[] = {geometry.finalCore().handle(),
                              geometry.finalFrame().handle(),
                              geometry.uv0().handle(),
                              geometry.uv1().handle(),
                              geometry.patternUv().handle(),
                              geometry.tint().handle(),
                              scene.previousPositions().handle(),
                              scene.transparent().partOfVertex(),
                              scene.indirect().handle()};
  constexpr VkDeviceSize kUv = sizeof(glm::vec2);
  const VkDeviceSize strides[std::size(buffers)] = {sizeof(shared::VertexCore),
                                                    sizeof(shared::VertexFrame),
                                                    kUv,
                                                    kUv,
                                                    kUv,
                                                    geometry.tintStride(),
                                                    sizeof(glm::vec3),
                                                    sizeof(uint32_t),
                                                    scene.indirectStride()};
  const VkDeviceSize offsets[std::size(buffers)] = {};
  vkCmdBindVertexBuffers2(commands, 0, uint32_t(std::size(buffers)), buffers, offsets, nullptr, strides);
}

}  // namespace scumble::frame
