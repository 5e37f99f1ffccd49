#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <optional>

#include "gltf/gaussians.h"
#include "gltf/import.h"
#include "gltf/primitive.h"
#include "gltf/strokes.h"
#include "scene/levels.h"
#include "scene/parallel.h"
#include "scene/prepare_mesh.h"

namespace scumble::gltf {

namespace {

// Every primitive of a mesh must have the same morph targets; those with fewer get empty ones.
void alignMorphTargets(Mesh& mesh) {
  size_t count = 0;
  for (const Primitive& p : mesh.primitives) count = std::max(count, p.morphTargets.size());
  for (Primitive& p : mesh.primitives) p.morphTargets.resize(count);
  mesh.morphWeights.resize(count, 0.0f);
}

void readMorphWeights(const JsonView& json, Mesh& mesh, ImportWarnings& warnings) {
  const JsonView weights = json.list("weights");
  if (!weights) return;
  std::vector<float> values(weights.size());
  try {
    json.numbers("weights", values.data(), values.size());
    mesh.morphWeights = std::move(values);
  } catch (const ImportFailure& failure) {
    warnIgnored(warnings, failure, "morph weights");
  }
}

bool isPaint(const Import& import, const JsonView& primitive) {
  const JsonView materials = import.document.list("materials");
  const auto index = primitive.json().find("material");
  if (index == primitive.json().end() || !index->is_number()) return false;
  const double number = index->get<double>();
  return number >= 0 && number < double(materials.size()) &&
         paintLayerOf(materials.at(size_t(number))).has_value();
}

}  // namespace

void readMeshes(const Import& import, const Maps& maps, SceneData& scene) {
  // What there is to read.
  const JsonView list = import.document.list("meshes");
  struct Task {
    size_t mesh, primitive;
    JsonView json;
    ImportWarnings warnings{};
    std::optional<ReadStroke> stroke{};
    std::vector<StrokePoint> gaussians{};
  };
  std::vector<Task> tasks;
  for (size_t i = 0; i < maps.meshes.size(); ++i) {
    if (maps.meshes[i] < 0) continue;
    const JsonView json = list.at(i), primitives = json.list("primitives");
    const size_t index = static_cast<size_t>(maps.meshes[i]);
    Mesh& mesh = scene.meshes[index].own();
    mesh.name = json.text("name");
    mesh.primitives.resize(primitives.size());
    readMorphWeights(json, mesh, import.warnings);
    for (size_t k = 0; k < primitives.size(); ++k) tasks.push_back({index, k, primitives.at(k)});
  }

  // Triangles, whole ones. The file's memory goes as they come, lest there be two of all.
  constexpr size_t kForgottenVertices = 1 << 18;
  std::atomic<size_t> vertices = 0;
  import.progress.expect(tasks.size(), 0.4);
  parallelFor(tasks.size(), import.threads, [&](size_t i) {
    Task& task = tasks[i];
    if (areGaussians(task.json)) {
      task.gaussians = readGaussians(import, task.json, task.warnings);
      import.progress.step();
      return;
    }
    if (isStroke(task.json)) {
      task.stroke = readStroke(import, task.json, task.warnings);
      import.progress.step();
      return;
    }
    Primitive& primitive = scene.meshes[task.mesh].own().primitives[task.primitive];
    primitive = readPrimitive(import, task.json, task.warnings);
    primitive.isPaint = isPaint(import, task.json);
    if (!primitive.indices.empty()) cleanPrimitive(primitive, task.json.path(), task.warnings);
    const size_t count = primitive.vertexCount(), before = vertices.fetch_add(count);
    if (before / kForgottenVertices != (before + count) / kForgottenVertices) import.buffers.forgetFiles();
    import.progress.step();
  });
  std::map<size_t, StrokeCollector> strokes;  // by mesh
  for (Task& task : tasks) {
    if (task.stroke) strokes[task.mesh].add(std::move(*task.stroke), task.json.path(), task.warnings);
    if (!task.gaussians.empty()) strokes[task.mesh].add(task.gaussians, task.json.path(), task.warnings);
    import.warnings.merge(task.warnings);
  }
  for (auto& [mesh, collector] : strokes) scene.meshes[mesh].own().painting = collector.finish();

  // Meshes as wholes.
  std::vector<float> radii(scene.meshes.size());
  parallelFor(scene.meshes.size(), import.threads, [&](size_t i) {
    Mesh& mesh = scene.meshes[i].own();
    std::erase_if(mesh.primitives, [](const Primitive& p) { return p.indices.empty(); });
    alignMorphTargets(mesh);
    weldSmoothNormals(mesh);
    radii[i] = boundingRadius(mesh);
  });

  for (Node& node : scene.nodes)
    if (!node.morphWeights.empty())
      node.morphWeights.resize(scene.meshes[node.mesh]->morphWeights.size(), 0.0f);

  // And all that is found from whole meshes.
  std::vector<std::pair<size_t, size_t>> finishing;
  for (size_t i = 0; i < scene.meshes.size(); ++i)
    for (size_t k = 0; k < scene.meshes[i]->primitives.size(); ++k) finishing.emplace_back(i, k);
  import.progress.expect(finishing.size(), 0.6);
  parallelFor(finishing.size(), import.threads, [&](size_t i) {
    const auto [mesh, primitive] = finishing[i];
    Primitive& finished = scene.meshes[mesh].own().primitives[primitive];
    finishPrimitive(finished, radii[mesh], import.patternCoordinates);
    if (!finished.isPaint) makeLevels(finished);
    import.progress.step();
  });
}

}  // namespace scumble::gltf
