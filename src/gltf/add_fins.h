// A glTF written anew with layers of paint on its meshes instead of strokes, as one .glb.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/import_warnings.h"
#include "scene/scene_data.h"
#include "scumble/scene.h"

namespace scumble::gltf {

// Triangles that become a primitive of a mesh. They move as the vertices do that carry them.
struct PaintPart {
  std::string name;                // of its material
  uint32_t primitive = 0;          // of the mesh
  std::vector<uint32_t> carriers;  // by vertex: which of that primitive's
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::vec2> uvs;
  std::vector<uint32_t> indices;
  scene::PaintLayer layer;
  bool isDoubleSided = true;
};

// All triangles of all parts in an order for viewers in one direction, of unit length. Vertices are counted
// through all parts.
struct PaintOrder {
  glm::vec3 toViewer;
  std::vector<uint32_t> indices;
};

struct PaintedMesh {
  std::vector<uint8_t> picture;    // a PNG, which all of its parts show
  std::vector<PaintPart> parts;    // none: the mesh stays as it is
  std::vector<PaintOrder> orders;  // become the mesh's extras: {"scumble_orders": ...} (docs/fins.md)
};

// `meshes`: by mesh of the scene that Scene::load makes of the file. Strokes go out; all else is as it was,
// but that buffers and pictures in other files become part of it. Fails with scene::ImportFailure.
std::vector<uint8_t> withPaint(const std::string& path, const SceneOptions& options,
                               const scene::SceneData& scene, const std::vector<PaintedMesh>& meshes,
                               scene::ImportWarnings& warnings);

// The same of a mesh that no file has: the paint alone, without the mesh. `origin`: the place in the world
// from which its positions count.
std::vector<uint8_t> paintAlone(const scene::Mesh& mesh, const PaintedMesh& painted,
                                const glm::dvec3& origin);

}  // namespace scumble::gltf
