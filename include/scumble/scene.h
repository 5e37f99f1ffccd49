// Scenes: glTF 2.0 files in memory, checked, with everything that the renderer draws from.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scumble/result.h"

namespace scumble {

namespace scene {
struct SceneData;
}

struct SceneOptions {
  int scene = -1;             // which of the file's scenes; -1: its default one
  bool allowOutside = false;  // whether URIs may lead out of the scene's folder upwards
  int threads = 0;            // for decoding; 0: as many as the machine has
};

// What loading took, in milliseconds of wall clock.
struct SceneTimings {
  double read = 0, parse = 0, geometry = 0, images = 0;
};

// What is in a file, for people and scripts.
struct SceneSummary {
  struct Clip {
    std::string name;
    double duration = 0;  // seconds
  };
  size_t meshes = 0, primitives = 0, triangles = 0, vertices = 0, nodes = 0, materials = 0, images = 0,
         skins = 0, morphTargets = 0;
  std::vector<std::string> cameras, lights, materialNames;
  std::vector<std::string> nodeNames;  // of those that have one, in the file's order
  std::vector<Clip> clips;
  std::vector<std::string> extensionsUsed, extensionsNotSupported;
  double min[3] = {0, 0, 0}, max[3] = {0, 0, 0};  // world bounds, metres
};

// An immutable scene; copies are cheap and share the data. May be used from several threads.
class Scene {
 public:
  // Reads .gltf or .glb. Fails with ErrorKind::unusableFile, and with usage for options out of range.
  static Result<Scene> load(const std::string& path, const SceneOptions& options = {});

  // The same from a glTF or GLB in memory; URIs are resolved relative to `folder`. With an empty `folder` no
  // file is ever opened: the scene must hold everything itself. `name` is what messages call it.
  static Result<Scene> loadFromMemory(const void* bytes, size_t size, const std::string& name,
                                      const std::string& folder, const SceneOptions& options = {});

  // Several scenes in one world, in the given order; cameras of the first come first.
  static Scene combine(const std::vector<Scene>& scenes);

  bool empty() const { return !data_; }  // true of a Scene that was not loaded

  SceneSummary summary() const;

  // Files beside its own that the scene names, whether or not they are there: who writes files spares these.
  const std::vector<std::string>& files() const;
  const std::vector<std::string>& warnings() const;  // what was ignored or replaced, each once
  const SceneTimings& timings() const;

  // The data behind it, for the library's own rooms; not of an empty one.
  const scene::SceneData& data() const { return *data_; }

 private:
  std::shared_ptr<const scene::SceneData> data_;
  SceneTimings timings_;
};

}  // namespace scumble
