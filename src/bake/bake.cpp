// From a painting to fins.
#include "scumble/bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <mutex>

#include "bake/mesh_bake.h"
#include "bake/orders.h"
#include "bake/subjects.h"
#include "base/file_bytes.h"
#include "base/name_pattern.h"
#include "base/usage.h"
#include "gltf/write_anew.h"
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
  if (options.hullCells < 8 || options.hullCells > 256)
    return usage("the hull's cells are out of range", "give 8 to 256");
  if (options.textureSize < 64 || options.textureSize > 8192)
    return usage("the texture's size is out of range", "give 64 to 8192");
  const auto isWithin = [](float value, float low, float high) { return value >= low && value <= high; };
  if (!isWithin(options.spacing, 0.25f, 4) || !isWithin(options.streaks, 0, 1) ||
      !isWithin(options.dryEnds, 0, 100) || !isWithin(options.variation, 0, 1) ||
      !isWithin(options.order, 0, 20))
    return usage("a number of the brush is out of range", "they have the ranges of the knobs painting.*");
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
  if (options.orders != 0 && orderDirections(options.orders).empty())
    return usage("there are no orders for " + std::to_string(options.orders) + " directions",
                 "give 0, 6, 8 or 14");
  return Done{};
}

bool isWorld(const std::string& path) {
  return std::filesystem::path(path).extension() == ".json";
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

uint64_t keyOf(const Subjects& subjects, const BakeOptions& options) {
  Key key;
  const auto addAll = [&](const auto& values) {
    key.add(values.size());
    key.add(Bytes(reinterpret_cast<const uint8_t*>(values.data()), values.size() * sizeof(values[0])));
  };
  addAll(std::string_view(SCUMBLE_VERSION_STRING));
  for (const scene::Mesh& mesh : subjects.meshes) {
    for (const scene::Primitive& p : mesh.primitives)
      addAll(p.positions), addAll(p.indices), key.add(p.material);
    if (!mesh.painting) continue;
    for (const scene::StrokePoint& point : mesh.painting->points)
      key.add(point.position), key.add(point.radius), key.add(point.color);
    for (const scene::Stroke& stroke : mesh.painting->strokes)
      key.add(stroke.firstPoint), key.add(stroke.brush);
  }
  for (const std::string& material : subjects.materials) {
    const PartOptions part = partOf(options, material);
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
  Result<Subjects> found = findSubjects(path, options);
  if (!found) return found.error();
  const Subjects& subjects = *found;
  for (const BakePart& part : options.parts)
    if (std::none_of(subjects.materials.begin(), subjects.materials.end(),
                     [&](const std::string& name) { return matches(part.materials, name); }))
      return usage("the scene has no material '" + part.materials + "'",
                   "`scumble info` lists its materials");

  // What cannot be written anew should say so before the work, and not after it.
  if (!subjects.isHull && isWorld(subjects.path))
    return usage("a world of several scenes cannot be written anew", "bake its scenes one by one");

  BakeReport report;
  report.warnings = subjects.warnings;
  const Status made = gltf::guarded(path, "baking", "ask for a smaller texture", [&]() -> Status {
    Checkpoint checkpoint(out + ".part", keyOf(subjects, options));
    std::vector<gltf::PaintedMesh> meshes(subjects.meshes.size());
    std::vector<size_t> painted;
    for (size_t m = 0; m < subjects.meshes.size(); ++m)
      if (subjects.meshes[m]->painting && !subjects.meshes[m]->painting->strokes.empty())
        painted.push_back(m);
    std::mutex mutex;
    double done = 0;
    bool isStopped = false;
    size_t left = 0;
    for (size_t i = 0; i < painted.size(); ++i) {
      const scene::Mesh& mesh = subjects.meshes[painted[i]];
      MeshBake bake;
      bake.mesh = &mesh;
      bake.isAlone = subjects.isHull;
      bake.firstPiece = uint64_t(painted[i]) << 32;
      for (const scene::Primitive& p : mesh.primitives) {
        const std::string& material = subjects.materials[size_t(p.material)];
        bake.names.push_back(material.empty() ? "material" : material);
        bake.parts.push_back(partOf(options, material));
      }
      const auto progress = [&](double part) {
        if (!options.progress) return;
        const std::lock_guard lock(mutex);
        // Threads come as they come.
        done = std::max(done, (double(i) + part) / double(painted.size()));
        isStopped = isStopped || !options.progress(done);
        if (isStopped)
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
    if (report.meshes == 0) {
      checkpoint.finish();
      return Error{ErrorKind::unusableFile,
                   path,
                   0,
                   "",
                   "has strokes, and no surface near them",
                   "fins stand on the triangles of the mesh that has the strokes, or of --proxy"};
    }
    scene::ImportWarnings warnings;
    SceneOptions sceneOptions;
    sceneOptions.allowOutside = options.allowOutside;
    const std::vector<uint8_t> file =
        subjects.isHull
            ? gltf::paintAlone(subjects.meshes[0], meshes[0], subjects.scene->origin())
            : gltf::withPaint(subjects.path, sceneOptions, subjects.scene->data(), meshes, warnings);
    gltf::addNew(report.warnings, warnings, subjects.path);
    Status status = gltf::putWhole(out, file);
    // Also where it cannot be put where it is wanted: on a full disk, what is kept is part of what fills it.
    if (status || status.error().kind == ErrorKind::outputNotWritten) checkpoint.finish();
    return status;
  });
  if (!made) return made.error();
  if (options.progress) options.progress(1);
  return report;
}

}  // namespace scumble
