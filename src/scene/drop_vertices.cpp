#include "scene/drop_vertices.h"

#include <algorithm>
#include <atomic>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace scumble::scene {

namespace {

template <class T>
size_t drop(std::vector<T>& values) {
  const size_t bytes = values.capacity() * sizeof(T);
  values = std::vector<T>();
  return bytes;
}

// What is freed in the middle of a heap stays the process's own until it is asked for.
void giveBack(size_t bytes) {
  constexpr size_t kStep = size_t(32) << 20;
  static std::atomic<size_t> freed = 0;
  const size_t before = freed.fetch_add(bytes);
#ifdef __GLIBC__
  if (before / kStep != (before + bytes) / kStep) malloc_trim(0);
#endif
}

}  // namespace

void dropVertices(const Primitive& p) {
  if (p.influences > 0 || !p.morphTargets.empty() || p.droppedVertices > 0) return;
  p.droppedVertices = p.vertexCount(), p.droppedIndices = p.indices.size();
  giveBack(drop(p.positions) + drop(p.normals) + drop(p.smoothNormals) + drop(p.uv0) + drop(p.uv1) +
           drop(p.patternUv) + drop(p.dPdu) + drop(p.dPdv) + drop(p.indices) + drop(p.levelIndices) +
           drop(p.addedFrom));
}

bool hasDroppedVertices(const SceneData& scene) {
  return std::any_of(scene.meshes.begin(), scene.meshes.end(), [](const Mesh& mesh) {
    return std::any_of(mesh.primitives.begin(), mesh.primitives.end(),
                       [](const Primitive& primitive) { return primitive.droppedVertices > 0; });
  });
}

}  // namespace scumble::scene
