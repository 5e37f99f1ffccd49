// What every part of the importer needs at hand, and the parts. Scene::load calls them in this order.
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "gltf/accessor.h"
#include "scene/scene_data.h"
#include "scumble/scene.h"

namespace scumble::gltf {

using namespace scene;

// Tells whoever waits; several threads may. Fails with ErrorKind::cancelled where that one wants to stop.
class ImportProgress {
 public:
  explicit ImportProgress(const Progress& callback) : callback_(callback) {}
  // From here on `count` steps lead to this part of all.
  void expect(size_t count, double part);
  void step();

 private:
  const Progress& callback_;
  std::mutex mutex_;
  double from_ = 0, to_ = 0;
  size_t count_ = 0, done_ = 0;
  bool isStopped_ = false;
};

struct Import {
  const Document& document;
  Buffers& buffers;
  Accessors& accessors;
  ImportBudget& budget;
  ImportWarnings& warnings;
  ImportProgress& progress;
  int threads = 1;
  PatternCoordinates patternCoordinates = PatternCoordinates::automatic;
};

// From the file's indices to ours; -1 where something is not part of the scene, or could not be used.
struct Maps {
  std::vector<int> nodes, meshes, cameras, lights, skins;
};

// The nodes of the chosen scene, parents first, with all that they carry. Meshes, cameras, lights and skins
// are numbered in the file's order, those in use only.
void readNodes(const Import& import, int wantedScene, SceneData& scene, Maps& maps);

// The meshes that nodes use, ready to draw.
void readMeshes(const Import& import, const Maps& maps, SceneData& scene);

// A channel, 0 to 3, of a texture that is a factor on the width of a material's outline; by material.
struct OutlineTexture {
  TextureUse use;
  int channel = 0;
};
using OutlineTextures = std::map<size_t, OutlineTexture>;
// What a material's extras say of it as a layer of paint; none where they say nothing, or something wrong.
std::optional<PaintLayer> paintLayerOf(const JsonView& material);
// All materials, and the images that materials in use name, decoded.
OutlineTextures readMaterials(const Import& import, SceneData& scene);
void readImages(const Import& import, SceneData& scene);
// Once images are there: Primitive::outlineWidths.
void readOutlineWidths(const OutlineTextures& textures, SceneData& scene);

void readCamerasAndLights(const Import& import, SceneData& scene, Maps& maps);
void readSkins(const Import& import, SceneData& scene, Maps& maps);
void readClips(const Import& import, const Maps& maps, SceneData& scene);

// Says what an optional thing ended with: "the camera is ignored: its yfov is not a number".
void warnIgnored(ImportWarnings& warnings, const ImportFailure& failure, const char* what);

}  // namespace scumble::gltf
