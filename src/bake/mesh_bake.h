// One mesh with its painting becomes layers of paint.
#pragma once

#include <functional>

#include "bake/checkpoint.h"
#include "gltf/add_fins.h"
#include "scene/painting.h"
#include "scumble/bake.h"

namespace scumble::bake {

// As a part of the proxy is made.
struct PartOptions {
  float offset = 0, fadeStart = 0, fadeEnd = 0;
  int layers = 1;
};

struct MeshBake {
  const scene::Mesh* mesh = nullptr;
  std::vector<std::string> names;  // by primitive: of its material
  std::vector<PartOptions> parts;  // by primitive
  bool isAlone = false;            // nothing hides the paint on its other side
  uint64_t firstPiece = 0;         // its number in the checkpoint
};

struct MeshReport {
  size_t splats = 0, left = 0, fins = 0, triangles = 0, resumed = 0;
  uint32_t width = 0, height = 0;
};

// `progress`: called with a part of the work, 0 to 1, from any thread; may throw to stop it.
gltf::PaintedMesh bakeMesh(const MeshBake& bake, const BakeOptions& options, Checkpoint& checkpoint,
                           const std::function<void(double)>& progress, MeshReport& report);

}  // namespace scumble::bake
