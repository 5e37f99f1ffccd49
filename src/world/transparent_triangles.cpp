#include "world/transparent_triangles.h"

#include <algorithm>

#include "stage/visibility.h"

namespace scumble::world {

bool TransparentTriangles::update(gpu::Device& device, std::vector<Part> parts,
                                  const std::function<void()>& settle) {
  if (parts == known_ && triangles_.handle()) return false;
  settle();
  known_ = std::move(parts);
  uint64_t triangles = 0, vertices = 0;
  for (const Part& part : known_) {
    triangles += part.primitive->indices.size() / 3;
    vertices = std::max<uint64_t>(vertices, part.firstVertex + part.primitive->vertexCount());
  }
  const uint64_t bytes = std::max<uint64_t>(1, triangles) * sizeof(shared::TransparentTriangle);
  device.requireBindable(bytes, "the scene's transparent triangles");
  count_ = uint32_t(triangles);
  isVisible_ = false;

  constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  gpu::Uploader uploader(device);
  std::byte* triangleBytes = nullptr;
  std::byte* vertexBytes = nullptr;
  triangles_ = uploader.reserve(bytes, kStorage, &triangleBytes);
  partOfVertex_ = uploader.reserve(std::max<uint64_t>(1, vertices) * sizeof(uint32_t),
                                   VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, &vertexBytes);
  indices_ = gpu::Buffer(device, std::max<uint64_t>(1, triangles) * 3 * sizeof(uint32_t),
                         kStorage | VK_BUFFER_USAGE_INDEX_BUFFER_BIT, gpu::MemoryKind::device);
  parts_ = gpu::PerFrameBuffer(device, std::max<size_t>(1, known_.size()) * sizeof(shared::TransparentPart),
                               kStorage);
  auto* triangle = reinterpret_cast<shared::TransparentTriangle*>(triangleBytes);
  auto* const partOf = reinterpret_cast<uint32_t*>(vertexBytes);
  std::fill_n(partOf, vertices, 0u);
  for (uint32_t p = 0; p < known_.size(); ++p) {
    const Part& part = known_[p];
    const std::vector<uint32_t>& indices = part.primitive->indices;
    for (size_t i = 0; i + 2 < indices.size(); i += 3)
      *triangle++ = {part.firstVertex + glm::uvec3(indices[i], indices[i + 1], indices[i + 2]), p};
    std::fill_n(partOf + part.firstVertex, part.primitive->vertexCount(), p);
    parts_.as<shared::TransparentPart>()[p] = {part.object, 0u, 0u, part.fadeStart, part.isCoat};
  }
  uploader.flush();
  return true;
}

void TransparentTriangles::look(const Viewers& viewers, const std::vector<scene::Bounds>& bounds,
                                const std::vector<uint8_t>& mirrored) {
  isVisible_ = false;
  farthest_.clear();
  for (size_t p = 0; p < known_.size(); ++p) {
    const Part& part = known_[p];
    const scene::Bounds& box = bounds[part.object];
    const bool isSeen = std::any_of(
        viewers.windows.begin(), viewers.windows.end(),
        [&](const Viewers::Window& window) { return mayBeSeen(box, window.worldToClip, window.margin); });
    float& farthest = farthest_[part.material];
    if (isSeen) farthest = std::max(farthest, viewers.distanceTo(box.center()));
    isVisible_ |= isSeen;
    parts_.as<shared::TransparentPart>()[p] = {
        part.object, part.material << 2 | uint32_t(part.varied) << 1 | uint32_t(mirrored[part.object]),
        isSeen ? 1u : 0u, part.fadeStart, part.isCoat};
  }
}

}  // namespace scumble::world
