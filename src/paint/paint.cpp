// From a glTF to the same with strokes.
#include "scumble/paint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/name_pattern.h"
#include "base/usage.h"
#include "gltf/add_strokes.h"
#include "gltf/write_anew.h"
#include "paint/mesh_strokes.h"
#include "scene/posed_bounds.h"
#include "scene/splat_places.h"
#include "scumble/nearest.h"
#include "scumble/scene.h"

namespace scumble {

namespace {

using namespace paint;

const StrokeStyle* styleOf(const std::string& name) {
  for (const StrokeStyle& style : strokeStyles())
    if (name == style.name) return &style;
  return nullptr;
}

Status checkOptions(const PaintOptions& options) {
  if (!styleOf(options.style)) {
    std::vector<std::string> names;
    std::string all;
    for (const StrokeStyle& style : strokeStyles()) {
      names.emplace_back(style.name);
      all += (all.empty() ? "" : ", ") + names.back();
    }
    const std::string meant = nearest(options.style, names);
    return usage("there is no style '" + options.style + "'",
                 meant.empty() ? "there are: " + all : "did you mean '" + meant + "'?");
  }
  if (options.splats < 1 || options.splats > 4000000)
    return usage("so many splats cannot be made", "give a number from 1 to 4000000");
  if (options.size != 0 && !(options.size >= 0.001f && options.size <= 1))
    return usage("the size is out of range", "give a part of the mesh's radius, from 0.001 to 1");
  if (!(options.height <= 10)) return usage("the height is out of range", "give at most 10 radii");
  if (!(options.variation >= 0 && options.variation <= 1))
    return usage("the variation is out of range", "give a number from 0 to 1");
  const float length = glm::length(options.direction);
  if (!(length > 1e-6f) || !std::isfinite(length))
    return usage("the direction points nowhere", "give three numbers like 0,-1,0");
  return Done{};
}

// What is painted: each mesh once, as it stands at the node where it is largest.
struct Painted {
  size_t mesh, node;
  glm::mat4 world;
  double area;  // world
};

std::vector<Painted> paintedOf(const scene::SceneData& scene, const std::string& nodes) {
  std::map<size_t, Painted> largest;  // by mesh
  const std::vector<glm::dmat4> world = scene::worldMatrices(scene);
  for (size_t n = 0; n < scene.nodes.size(); ++n) {
    const scene::Node& node = scene.nodes[n];
    if (node.mesh < 0 || (!nodes.empty() && !matches(nodes, node.name))) continue;
    const auto mesh = size_t(node.mesh);
    const glm::mat4 placed = scene::restPlaceOf(scene, world, n);
    const double scale = std::cbrt(std::abs(double(glm::determinant(glm::mat3(placed)))));
    const Painted here{mesh, n, placed, scale * scale};
    const auto [known, isNew] = largest.try_emplace(mesh, here);
    if (!isNew && here.area > known->second.area) known->second = here;
  }
  std::vector<Painted> painted;
  for (const auto& [mesh, here] : largest) {
    painted.push_back(here);
    painted.back().area *= paint::areaOf(scene.meshes[mesh]);
  }
  return painted;
}

// A direction in the world as a mesh has it.
glm::vec3 towardsIn(const glm::mat4& placed, const glm::vec3& direction) {
  const glm::vec3 own = glm::inverse(glm::mat3(placed)) * direction;
  const float length = glm::length(own);
  return length > 0 && std::isfinite(length) ? own / length : glm::normalize(direction);
}

float radiusOf(const scene::Mesh& mesh) {
  scene::Bounds box;
  for (const scene::Primitive& p : mesh.primitives) box.add(p.extent.box);
  return box.radius();
}

}  // namespace

std::vector<PaintStyle> paintStyles() {
  std::vector<PaintStyle> styles;
  for (const StrokeStyle& style : strokeStyles()) styles.push_back({style.name, style.meaning});
  return styles;
}

Result<PaintReport> paintScene(const std::string& path, const std::string& out, const PaintOptions& options) {
  if (const Status status = checkOptions(options); !status) return status.error();
  SceneOptions sceneOptions;
  sceneOptions.allowOutside = options.allowOutside;
  const Result<Scene> loaded = Scene::load(path, sceneOptions);
  if (!loaded) return loaded.error();
  const scene::SceneData& scene = loaded->data();
  const std::vector<Painted> painted = paintedOf(scene, options.nodes);
  double area = 0;
  for (const Painted& one : painted) area += one.area;
  if (painted.empty() && !options.nodes.empty())
    return usage("the scene has no node '" + options.nodes + "' with a mesh",
                 "`scumble info` lists its nodes");
  if (!(area > 0))
    return Error{ErrorKind::unusableFile,      path, 0, "", "holds no surface that could be painted",
                 "give a scene with triangles"};
  std::optional<LookColors> colors;
  if (options.renderer && options.look) {
    Result<LookColors> made = LookColors::make(*options.renderer, *loaded, *options.look);
    if (!made) return made.error();
    colors = std::move(made).value();
  }
  const StrokeStyle& style = *styleOf(options.style);
  PaintReport report;
  report.warnings = loaded->warnings();
  const Status made = gltf::guarded(path, "painting", "ask for fewer splats", [&]() -> Status {
    std::vector<std::shared_ptr<const scene::Painting>> paintings(scene.meshes.size());
    // After all that is painted already.
    float clock = 0;
    for (const scene::Mesh& mesh : scene.meshes)
      if (mesh.painting) clock = std::max(clock, mesh.painting->duration);
    for (size_t i = 0; i < painted.size(); ++i) {
      if (options.progress && !options.progress(double(i) / double(painted.size())))
        return Error{ErrorKind::cancelled, "", 0, "", "painting was cancelled", ""};
      const scene::Mesh& mesh = scene.meshes[painted[i].mesh];
      const float radius = radiusOf(mesh);
      MeshPaint how;
      how.style = &style;
      how.size = radius * (options.size > 0 ? options.size : style.size);
      how.height = radius * (options.height >= 0 ? options.height : style.height);
      how.splats = size_t(std::llround(double(options.splats) * painted[i].area / area));
      how.flow = options.flow;
      how.towards = towardsIn(painted[i].world, options.direction);
      how.variation = options.variation;
      how.seed = options.seed;
      how.begin = clock;
      const PosedMesh posed = colors ? posedAtRest(scene, painted[i].node) : PosedMesh();
      if (colors) how.colors = &*colors, how.posed = &posed;
      scene::Painting painting = strokesOver(scene, mesh, how);
      if (painting.strokes.empty()) continue;
      clock = painting.duration;
      std::vector<float> along;
      ++report.meshes;
      report.strokes += painting.strokes.size();
      report.points += painting.points.size();
      report.splats += scene::splatPlaces(painting, along).size();
      paintings[painted[i].mesh] = std::make_shared<const scene::Painting>(std::move(painting));
    }
    scene::ImportWarnings warnings;
    const std::vector<uint8_t> file = gltf::withStrokes(path, sceneOptions, scene, paintings, warnings);
    gltf::addNew(report.warnings, warnings, path);
    return gltf::putWhole(out, file);
  });
  if (!made) return made.error();
  if (options.progress) options.progress(1);
  return report;
}

}  // namespace scumble
