// From a painting to fins.
#include "scumble/bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "bake/mesh_bake.h"
#include "base/file_bytes.h"
#include "base/name_pattern.h"
#include "base/usage.h"
#include "base/whole_file.h"
#include "scene/import_failure.h"
#include "scumble/scene.h"
#include "scumble/version.h"

namespace scumble {

namespace {

using namespace bake;

Status checkFade(float start, float end, const std::string& whose) {
  if (start >= 0 && start <= 1 && end >= 0 && end < start) return Done{};
  return usage(whose + "fade is out of range", "give a start from 0 to 1 and an end from 0 to below it");
}

PartOptions partOf(const BakeOptions& options, const std::string& material) {
  PartOptions part{0, options.fadeStart, options.fadeEnd, options.layers};
  for (const BakePart& given : options.parts) {
    if (!matches(given.materials, material)) continue;
    part = {given.offset, given.fadeStart >= 0 ? given.fadeStart : options.fadeStart,
            given.fadeEnd >= 0 ? given.fadeEnd : options.fadeEnd,
            given.layers > 0 ? given.layers : options.layers};
  }
  return part;
}

Status checkOptions(const BakeOptions& options) {
  if (options.textureSize < 64 || options.textureSize > 8192)
    return usage("the texture's size is out of range", "give 64 to 8192");
  if (options.layers < 1 || options.layers > 16)
    return usage("so many layers cannot be made", "give 1 to 16");
  if (Status status = checkFade(options.fadeStart, options.fadeEnd, "the "); !status) return status;
  for (const BakePart& part : options.parts) {
    const std::string whose = "of part '" + part.materials + "' the ";
    if (!(part.offset >= 0) || !std::isfinite(part.offset))
      return usage(whose + "offset is out of range", "give metres above 0");
    if (part.layers < 0 || part.layers > 16) return usage(whose + "layers are out of range", "give 1 to 16");
    if (Status status = checkFade(part.fadeStart >= 0 ? part.fadeStart : options.fadeStart,
                                  part.fadeEnd >= 0 ? part.fadeEnd : options.fadeEnd, whose);
        !status)
      return status;
  }
  return Done{};
}

// Of everything that pieces follow from: FNV-1a.
class Key {
 public:
  void add(Bytes bytes) {
    for (const uint8_t byte : bytes) hash_ = (hash_ ^ byte) * 1099511628211ull;
  }
  template <class T>
  void add(const T& value) {
    add(Bytes(reinterpret_cast<const uint8_t*>(&value), sizeof value));
  }
  uint64_t value() const { return hash_; }

 private:
  uint64_t hash_ = 14695981039346656037ull;
};

uint64_t keyOf(const std::string& path, const scene::SceneData& scene, const BakeOptions& options) {
  Key key;
  const auto addText = [&](std::string_view text) {
    key.add(Bytes(reinterpret_cast<const uint8_t*>(text.data()), text.size()));
  };
  addText(SCUMBLE_VERSION_STRING);
  std::string problem;
  if (FileBytes file; file.open(path, problem)) key.add(file.bytes());
  // Buffers in other files.
  for (const scene::Mesh& mesh : scene.meshes) {
    for (const scene::Primitive& p : mesh.primitives)
      key.add(Bytes(reinterpret_cast<const uint8_t*>(p.positions.data()),
                    p.positions.size() * sizeof(glm::vec3)));
    if (!mesh.painting) continue;
    for (const scene::StrokePoint& point : mesh.painting->points)
      key.add(point.position), key.add(point.radius), key.add(point.color);
  }
  for (const scene::Material& material : scene.materials) {
    const PartOptions part = partOf(options, material.name);
    key.add(part.offset), key.add(part.layers);
  }
  key.add(options.textureSize);
  for (const float value :
       {options.spacing, options.streaks, options.dryEnds, options.variation, options.order})
    key.add(value);
  return key.value();
}

}  // namespace

Result<BakeReport> bakeFins(const std::string& path, const std::string& out, const BakeOptions& options) {
  if (const Status status = checkOptions(options); !status) return status.error();
  SceneOptions sceneOptions;
  sceneOptions.allowOutside = options.allowOutside;
  sceneOptions.threads = options.threads;
  const Result<Scene> loaded = Scene::load(path, sceneOptions);
  if (!loaded) return loaded.error();
  const scene::SceneData& scene = loaded->data();
  for (const BakePart& part : options.parts)
    if (std::none_of(scene.materials.begin(), scene.materials.end(),
                     [&](const scene::Material& m) { return matches(part.materials, m.name); }))
      return usage("the scene has no material '" + part.materials + "'",
                   "`scumble info` lists its materials");
  const auto isPainted = [](const scene::Mesh& mesh) {
    return mesh.painting && !mesh.painting->strokes.empty();
  };
  std::vector<size_t> painted;
  for (size_t m = 0; m < scene.meshes.size(); ++m)
    if (isPainted(scene.meshes[m])) painted.push_back(m);
  if (painted.empty())
    return Error{
        ErrorKind::unusableFile, path, 0, "", "has no strokes", "paint it first: scumble paint " + path};

  BakeReport report;
  report.warnings = loaded->warnings();
  try {
    Checkpoint checkpoint(out + ".part", keyOf(path, scene, options));
    std::vector<gltf::PaintedMesh> meshes(scene.meshes.size());
    std::mutex mutex;
    size_t left = 0;
    for (size_t i = 0; i < painted.size(); ++i) {
      const scene::Mesh& mesh = scene.meshes[painted[i]];
      MeshBake bake;
      bake.mesh = &mesh;
      bake.firstPiece = uint64_t(painted[i]) << 32;
      for (const scene::Primitive& p : mesh.primitives) {
        const scene::Material& material = scene.materials[size_t(p.material)];
        bake.names.push_back(material.name.empty() ? "material" : material.name);
        bake.parts.push_back(partOf(options, material.name));
      }
      const auto progress = [&](double part) {
        if (!options.progress) return;
        const std::lock_guard lock(mutex);
        if (!options.progress((double(i) + part) / double(painted.size())))
          throw scene::ImportFailure{{ErrorKind::cancelled, "", 0, "", "baking was cancelled", ""}};
      };
      MeshReport own;
      meshes[painted[i]] = bakeMesh(bake, options, checkpoint, progress, own);
      if (meshes[painted[i]].parts.empty())
        report.warnings.push_back(path + ": mesh '" + mesh.name +
                                  "' has no surface near its strokes, which are left out");
      else
        ++report.meshes;
      report.splats += own.splats, report.fins += own.fins, report.triangles += own.triangles;
      report.resumed += own.resumed, left += own.left;
      report.textureWidth = std::max(report.textureWidth, own.width);
      report.textureHeight = std::max(report.textureHeight, own.height);
    }
    if (left > 0)
      report.warnings.push_back(fmt::format(
          "{}: {} splats lie too far from the surface, or too deep below it, and are left out", path, left));
    if (report.meshes == 0)
      return Error{ErrorKind::unusableFile,
                   path,
                   0,
                   "",
                   "has strokes, and no surface near them",
                   "fins stand on the triangles of the mesh that has the strokes"};
    scene::ImportWarnings warnings;
    const std::vector<uint8_t> file = gltf::withPaint(path, sceneOptions, scene, meshes, warnings);
    for (const std::string& line : warnings.lines(path))
      if (std::find(report.warnings.begin(), report.warnings.end(), line) == report.warnings.end())
        report.warnings.push_back(line);
    WholeFile target(out);
    target.write(file.data(), file.size());
    if (const Status status = target.commit(); !status) return status.error();
    checkpoint.finish();
  } catch (scene::ImportFailure& failure) {
    if (failure.error.kind != ErrorKind::cancelled) failure.error.file = path;
    return failure.error;
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::unusableFile,    path, 0, "", "needs more memory than there is",
                 "ask for a smaller texture"};
  } catch (const std::exception& error) {
    return Error{ErrorKind::internal,      path, 0, "", std::string("baking failed: ") + error.what(),
                 "please report this file"};
  }
  if (options.progress) options.progress(1);
  return report;
}

}  // namespace scumble
