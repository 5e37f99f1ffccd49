// From a file to a scene.
#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <functional>

#include "gltf/import.h"
#include "gltf/world_file.h"
#include "scene/clearance.h"
#include "scene/painting.h"
#include "scene/parallel.h"
#include "scene/scene_bounds.h"
#include "scumble/scene.h"
#include "sketch/sketch.h"

namespace scumble {

namespace {

using namespace gltf;

class Stopwatch {
 public:
  // Milliseconds since the last call.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    return ms;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

FileAccess accessOf(const SceneOptions& options) {
  return options.mapsFiles ? FileAccess::mapped : FileAccess::read;
}

// `file`: what the bytes are part of; null: of somebody else's memory.
std::shared_ptr<SceneData> import(Bytes bytes, const FileBytes* file, const std::string& name,
                                  const std::string& folder, const SceneOptions& options,
                                  SceneTimings& timings) {
  Stopwatch watch;
  auto data = std::make_shared<SceneData>();
  data->name = std::filesystem::path(name).stem().string();
  data->keepsVertices = options.keepsVertices;
  ImportWarnings warnings;
  ImportBudget budget;
  budget.addBacking(bytes.size());
  const Document document(bytes, warnings);
  Buffers buffers(document, file, folder, options.allowOutside, accessOf(options), budget);
  data->files = buffers.files();
  Accessors accessors(document, buffers, budget);
  ImportProgress progress(options.progress);
  const Import import{document,
                      buffers,
                      accessors,
                      budget,
                      warnings,
                      progress,
                      threadCount(options.threads),
                      options.patternCoordinates};
  progress.expect(1, 0.1);
  progress.step();
  data->extensionsUsed = document.extensionsUsed();
  data->extensionsNotSupported = document.extensionsNotSupported();
  data->facesBack = std::find(data->extensionsUsed.begin(), data->extensionsUsed.end(), "VRM") !=
                    data->extensionsUsed.end();
  timings.parse = watch.lap();

  Maps maps;
  readNodes(import, options.scene, *data, maps);
  readMeshes(import, maps, *data);
  readCamerasAndLights(import, *data, maps);
  readSkins(import, *data, maps);
  readClips(import, maps, *data);
  timings.geometry = watch.lap();

  const OutlineTextures outlines = readMaterials(import, *data);
  readImages(import, *data);
  readOutlineWidths(outlines, *data);
  timings.images = watch.lap();

  placeScene(*data, warnings);
  requireMeshes(*data);
  if (data->bounds.empty)
    warnings.add("nodes", "nothing is to be seen: all that it draws is hidden, of scale 0 or transparent");
  keepLevelsApart(*data);
  timings.geometry += watch.lap();
  data->warnings = warnings.lines(name);
  progress.expect(1, 1);
  progress.step();
  return data;
}

// A painting of another program: one node that carries it.
std::shared_ptr<SceneData> importSketch(const std::string& name, const SceneOptions& options,
                                        const std::function<Painting(ImportWarnings&)>& read,
                                        SceneTimings& timings) {
  Stopwatch watch;
  ImportWarnings warnings;
  ImportProgress progress(options.progress);
  progress.expect(1, 1);
  auto data = std::make_shared<SceneData>();
  data->name = std::filesystem::path(name).stem().string();
  data->keepsVertices = options.keepsVertices;
  data->materials.resize(1);
  Mesh mesh;
  mesh.name = data->name;
  if (Painting painting = read(warnings); !painting.strokes.empty())
    mesh.painting = std::make_shared<const Painting>(std::move(painting));
  timings.parse = watch.lap();
  data->meshes.push_back(std::move(mesh));
  Node& node = data->nodes.emplace_back();
  node.name = data->name;
  node.mesh = 0;
  placeScene(*data, warnings);
  requireMeshes(*data);
  timings.geometry = watch.lap();
  data->warnings = warnings.lines(name);
  progress.step();
  return data;
}

std::shared_ptr<SceneData> importBytes(Bytes bytes, const FileBytes* file, const std::string& name,
                                       const std::string& folder, const SceneOptions& options,
                                       SceneTimings& timings) {
  if (!sketch::isSketch(bytes)) return import(bytes, file, name, folder, options, timings);
  return importSketch(
      name, options, [&](ImportWarnings& warnings) { return sketch::readSketch(bytes, warnings); }, timings);
}

Error internalError(const std::string& name, const std::string& what) {
  return Error{ErrorKind::internal, name, 0, {}, "the importer failed: " + what, "please report this file"};
}

// With what fails as an error.
Result<std::shared_ptr<SceneData>> tryImport(const std::string& name, const SceneOptions& options,
                                             const std::function<std::shared_ptr<SceneData>()>& import) {
  if (options.scene < -1)
    return Error{
        ErrorKind::usage,           name, 0, {}, "there is no scene " + std::to_string(options.scene),
        "scenes are counted from 0"};
  try {
    return import();
  } catch (ImportFailure& failure) {
    failure.error.file = name;
    return failure.error;
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::unusableFile, name, 0, {}, "needs more memory than there is",
                 "use a smaller scene"};
  } catch (const std::exception& error) {
    return internalError(name, error.what());
  }
}

}  // namespace

void gltf::ImportProgress::expect(size_t count, double part) {
  from_ = to_, to_ = part, count_ = count, done_ = 0;
}

void gltf::ImportProgress::step() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++done_;
  const double part = from_ + (to_ - from_) * double(done_) / double(std::max<size_t>(1, count_));
  isStopped_ = isStopped_ || (callback_ && !callback_(part));
  if (isStopped_) throw ImportFailure{Error{ErrorKind::cancelled, "", 0, "", "loading was cancelled", ""}};
}

Result<Scene> Scene::load(const std::string& path, const SceneOptions& options) {
  try {
    Scene scene;
    const auto finish = [&](Result<std::shared_ptr<SceneData>> data) -> Result<Scene> {
      if (!data) return data.error();
      data.value()->path = path;
      scene.data_ = std::move(data).value();
      return scene;
    };
    if (sketch::isSketchFolder(path))
      return finish(tryImport(path, options, [&] {
        return importSketch(
            path, options, [&](ImportWarnings& w) { return sketch::readSketchFolder(path, w); },
            scene.timings_);
      }));
    Stopwatch watch;
    FileBytes file;
    std::string problem;
    if (!file.open(path, problem, accessOf(options)))
      return Error{ErrorKind::unusableFile, path, 0, {}, problem, "give the path of a .gltf, .glb or .tilt"};
    scene.timings_.read = watch.lap();
    if (path.ends_with(".json") && !sketch::isSketch(file.bytes()))
      if (std::optional<Result<Scene>> world = loadWorld(path, options)) return *std::move(world);
    std::string folder = std::filesystem::path(path).parent_path().string();
    if (folder.empty()) folder += '.';
    return finish(tryImport(path, options, [&] {
      return importBytes(file.bytes(), &file, path, folder, options, scene.timings_);
    }));
  } catch (const std::exception& error) {
    return internalError(path, error.what());
  }
}

Result<Scene> Scene::loadFromMemory(const void* bytes, size_t size, const std::string& name,
                                    const std::string& folder, const SceneOptions& options) {
  Scene scene;
  auto data = tryImport(name, options, [&] {
    return importBytes({static_cast<const uint8_t*>(bytes), size}, nullptr, name, folder, options,
                       scene.timings_);
  });
  if (!data) return data.error();
  scene.data_ = std::move(data).value();
  return scene;
}

}  // namespace scumble
