#include "bake/subjects.h"

#include <algorithm>
#include <cmath>

#include "bake/hull.h"
#include "scene/import_warnings.h"
#include "scene/nearest_place.h"
#include "scene/posed_bounds.h"
#include "scene/seen.h"

namespace scumble::bake {

namespace {

bool hasTriangles(const scene::Mesh& mesh) {
  return std::any_of(mesh.primitives.begin(), mesh.primitives.end(),
                     [](const scene::Primitive& p) { return !p.indices.empty(); });
}

using Strokes = std::vector<std::pair<scene::Brush, std::vector<scene::StrokePoint>>>;

std::vector<scene::StrokePoint> moved(const scene::StrokePoint* from, size_t count, const glm::mat4& by) {
  const glm::mat3 linear(by);
  const float scale = std::cbrt(std::abs(glm::determinant(linear)));
  glm::mat3 turn = linear;
  for (int i = 0; i < 3; ++i)
    turn[i] = glm::length(turn[i]) > 0 ? glm::normalize(turn[i]) : glm::mat3(1.0f)[i];
  const glm::quat orientation = glm::quat_cast(turn);
  std::vector<scene::StrokePoint> points(from, from + count);
  for (scene::StrokePoint& p : points) {
    p.position = glm::vec3(by * glm::vec4(p.position, 1));
    p.radius *= scale;
    p.orientation = orientation * p.orientation;
  }
  return points;
}

// All strokes of a scene, in the world, relative to an origin.
Strokes strokesOf(const scene::SceneData& scene, const glm::dvec3& origin) {
  Strokes strokes;
  std::vector<glm::dmat4> world = scene::worldMatrices(scene);
  for (glm::dmat4& node : world) node = glm::translate(glm::dmat4(1.0), scene.origin - origin) * node;
  const std::vector<bool> shown = scene::shownNodes(scene);
  for (size_t n = 0; n < scene.nodes.size(); ++n) {
    const scene::Node& node = scene.nodes[n];
    if (node.mesh < 0 || !shown[n] || !scene.meshes[size_t(node.mesh)]->painting) continue;
    const scene::Painting& painting = *scene.meshes[size_t(node.mesh)]->painting;
    for (const scene::Stroke& stroke : painting.strokes)
      strokes.emplace_back(stroke.brush, moved(&painting.points[stroke.firstPoint], stroke.pointCount,
                                               scene::restPlaceOf(scene, world, n)));
  }
  return strokes;
}

std::shared_ptr<const scene::Painting> paintingOf(const Strokes& strokes, const glm::mat4& by) {
  auto painting = std::make_shared<scene::Painting>();
  scene::ImportWarnings warnings;
  for (const auto& [brush, points] : strokes)
    painting->add(brush, moved(points.data(), points.size(), by), "", warnings);
  painting->finish();
  return painting;
}

// A mesh of the proxy as it stands at its first node.
struct StandingPlace {
  size_t mesh;
  glm::mat4 place;
  std::unique_ptr<scene::NearestPlaces> nearest;
  std::vector<const scene::Primitive*> primitives;
  Strokes strokes;

  float distanceTo(const glm::vec3& world) const {
    const glm::vec3 own(glm::inverse(place) * glm::vec4(world, 1));
    const scene::NearestPlaces::Place found = nearest->to(own);
    const glm::vec3 on = found.mixed(primitives[found.primitive]->positions);
    return glm::distance(world, glm::vec3(place * glm::vec4(on, 1)));
  }
};

void hangOn(Subjects& subjects, const scene::SceneData& proxy, Strokes strokes) {
  std::vector<StandingPlace> stands;
  const std::vector<glm::dmat4> world = scene::worldMatrices(proxy);
  std::vector<bool> isKnown(proxy.meshes.size());
  for (size_t n = 0; n < proxy.nodes.size(); ++n) {
    const int m = proxy.nodes[n].mesh;
    if (m < 0 || isKnown[size_t(m)]) continue;
    isKnown[size_t(m)] = true;
    StandingPlace stand{size_t(m), scene::restPlaceOf(proxy, world, n), nullptr, {}, {}};
    for (const scene::Primitive& p : subjects.meshes[size_t(m)]->primitives) stand.primitives.push_back(&p);
    stand.nearest = std::make_unique<scene::NearestPlaces>(stand.primitives);
    if (!stand.nearest->isEmpty() && std::abs(glm::determinant(glm::mat3(stand.place))) > 1e-30f)
      stands.push_back(std::move(stand));
  }
  if (stands.empty()) return;
  for (auto& stroke : strokes) {
    const glm::vec3 middle = stroke.second[stroke.second.size() / 2].position;
    StandingPlace* best = &stands[0];
    if (stands.size() > 1) {
      float least = INFINITY;
      for (StandingPlace& stand : stands)
        if (const float distance = stand.distanceTo(middle); distance < least)
          least = distance, best = &stand;
    }
    best->strokes.push_back(std::move(stroke));
  }
  for (StandingPlace& stand : stands)
    if (!stand.strokes.empty())
      subjects.meshes[stand.mesh].own().painting = paintingOf(stand.strokes, glm::inverse(stand.place));
}

}  // namespace

std::shared_ptr<const scene::Painting> paintingInWorld(const scene::SceneData& scene) {
  return paintingOf(strokesOf(scene, scene.origin), glm::mat4(1.0f));
}

Result<Subjects> findSubjects(const std::string& path, const BakeOptions& options) {
  SceneOptions sceneOptions;
  sceneOptions.allowOutside = options.allowOutside;
  sceneOptions.threads = options.threads;
  Result<Scene> painting = Scene::load(path, sceneOptions);
  if (!painting) return painting.error();
  Subjects subjects;
  subjects.path = path;
  subjects.warnings = painting->warnings();
  const auto take = [&](const Scene& scene) {
    subjects.scene = scene;
    subjects.meshes = scene.data().meshes;
    for (const scene::Material& material : scene.data().materials)
      subjects.materials.push_back(material.name);
  };
  const auto isPainted = [](const scene::Mesh& mesh) {
    return mesh.painting && !mesh.painting->strokes.empty();
  };
  const auto& meshes = painting->data().meshes;
  if (std::none_of(meshes.begin(), meshes.end(), isPainted))
    return Error{
        ErrorKind::unusableFile, path, 0, "", "has no strokes", "paint it first: scumble paint " + path};
  if (!options.proxy.empty()) {
    Result<Scene> proxy = Scene::load(options.proxy, sceneOptions);
    if (!proxy) return proxy.error();
    subjects.path = options.proxy;
    for (const std::string& line : proxy->warnings()) subjects.warnings.push_back(line);
    take(*proxy);
    for (Shared<scene::Mesh>& mesh : subjects.meshes)
      if (mesh->painting) mesh.own().painting = nullptr;
    hangOn(subjects, proxy->data(), strokesOf(painting->data(), proxy->origin()));
    return subjects;
  }
  take(*painting);
  if (std::any_of(subjects.meshes.begin(), subjects.meshes.end(),
                  [&](const scene::Mesh& mesh) { return isPainted(mesh) && hasTriangles(mesh); }))
    return subjects;
  subjects.isHull = true;
  scene::Mesh hull;
  hull.name = painting->data().name;
  hull.painting = paintingInWorld(painting->data());
  hull.primitives.push_back(hullOf(*hull.painting, options.hullCells));
  subjects.meshes = {hull};
  subjects.materials = {"painting"};
  return subjects;
}

}  // namespace scumble::bake
