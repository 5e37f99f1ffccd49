#include "scumble/scene.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>

#include "scene/gltf_import.h"
#include "scene/parallel.h"
#include "scene/scene_bounds.h"
#include "scene/world_file.h"

namespace scumble {

namespace {

using namespace scene;

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

std::shared_ptr<SceneData> import(Bytes bytes, const std::string& name, const std::string& folder,
                                  const SceneOptions& options, SceneTimings& timings) {
  Stopwatch watch;
  auto data = std::make_shared<SceneData>();
  data->name = std::filesystem::path(name).stem().string();
  ImportWarnings warnings;
  ImportBudget budget;
  budget.addBacking(bytes.size());
  const GltfDocument document(bytes, warnings);
  GltfBuffers buffers(document, folder, options.allowOutside, budget);
  data->files = buffers.files();
  GltfAccessors accessors(document, buffers, budget);
  ImportProgress progress(options.progress);
  const GltfImport import{
      document, buffers, accessors, budget, warnings, progress, threadCount(options.threads)};
  progress.expect(1, 0.1);
  progress.step();
  data->extensionsUsed = document.extensionsUsed();
  data->extensionsNotSupported = document.extensionsNotSupported();
  timings.parse = watch.lap();

  GltfMaps maps;
  readNodes(import, options.scene, *data, maps);
  readMeshes(import, maps, *data);
  readCamerasAndLights(import, *data, maps);
  readSkins(import, *data, maps);
  readClips(import, maps, *data);
  placeScene(*data, warnings);
  requireMeshes(*data);
  timings.geometry = watch.lap();

  readMaterials(import, *data);
  readImages(import, *data);
  timings.images = watch.lap();
  data->warnings = warnings.lines(name);
  progress.expect(1, 1);
  progress.step();
  return data;
}

const SceneData& emptyScene() {
  static const SceneData empty;
  return empty;
}

Error internalError(const std::string& name, const std::string& what) {
  return Error{ErrorKind::internal, name, 0, {}, "the importer failed: " + what, "please report this file"};
}

}  // namespace

void scene::ImportProgress::expect(size_t count, double part) {
  from_ = to_, to_ = part, count_ = count, done_ = 0;
}

void scene::ImportProgress::step() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++done_;
  const double part = from_ + (to_ - from_) * double(done_) / double(std::max<size_t>(1, count_));
  isStopped_ = isStopped_ || (callback_ && !callback_(part));
  if (isStopped_) throw ImportFailure{Error{ErrorKind::cancelled, "", 0, "", "loading was cancelled", ""}};
}

Result<Scene> Scene::load(const std::string& path, const SceneOptions& options) {
  try {
    if (path.ends_with(".json"))
      if (std::optional<Result<Scene>> world = loadWorld(path, options)) return *std::move(world);
    Stopwatch watch;
    FileBytes file;
    std::string problem;
    if (!file.open(path, problem))
      return Error{ErrorKind::unusableFile, path, 0, {}, problem, "give the path of a .gltf or .glb"};
    const double read = watch.lap();
    std::string folder = std::filesystem::path(path).parent_path().string();
    if (folder.empty()) folder += '.';
    Result<Scene> scene = loadFromMemory(file.bytes().data(), file.bytes().size(), path, folder, options);
    if (scene) scene->timings_.read = read;
    return scene;
  } catch (const std::exception& error) {
    return internalError(path, error.what());
  }
}

Result<Scene> Scene::loadFromMemory(const void* bytes, size_t size, const std::string& name,
                                    const std::string& folder, const SceneOptions& options) {
  if (options.scene < -1)
    return Error{
        ErrorKind::usage,           name, 0, {}, "there is no scene " + std::to_string(options.scene),
        "scenes are counted from 0"};
  try {
    Scene scene;
    scene.data_ = import({static_cast<const uint8_t*>(bytes), size}, name, folder, options, scene.timings_);
    return scene;
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

const std::vector<std::string>& Scene::warnings() const {
  return data_ ? data_->warnings : emptyScene().warnings;
}

const std::vector<std::string>& Scene::files() const {
  return data_ ? data_->files : emptyScene().files;
}

const SceneTimings& Scene::timings() const {
  return timings_;
}

SceneSummary Scene::summary() const {
  const SceneData& data = data_ ? *data_ : emptyScene();
  SceneSummary s;
  s.meshes = data.meshes.size();
  s.nodes = data.nodes.size();
  s.materials = data.materials.size();
  s.images = data.images.size();
  s.skins = data.skins.size();
  for (const Mesh& mesh : data.meshes) {
    s.primitives += mesh.primitives.size();
    s.morphTargets += mesh.morphWeights.size();
    for (const Primitive& p : mesh.primitives) {
      s.triangles += p.indices.size() / 3;
      s.vertices += p.vertexCount();
    }
  }
  for (const Camera& camera : data.cameras) s.cameras.push_back(camera.name);
  for (const Light& light : data.lights) s.lights.push_back(light.name);
  // The first is glTF's default, which is in no file.
  for (size_t m = 1; m < data.materials.size(); ++m) s.materialNames.push_back(data.materials[m].name);
  for (const Node& node : data.nodes)
    if (!node.name.empty()) s.nodeNames.push_back(node.name);
  for (const Clip& clip : data.clips) s.clips.push_back({clip.name, clip.duration});
  s.extensionsUsed = data.extensionsUsed;
  s.extensionsNotSupported = data.extensionsNotSupported;
  for (int i = 0; i < 3; ++i) {
    s.min[i] = data.bounds.min[i];
    s.max[i] = data.bounds.max[i];
  }
  return s;
}

}  // namespace scumble
