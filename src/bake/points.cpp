// A painting as a cloud of Gaussians, for viewers of KHR_gaussian_splatting.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "bake/splats.h"
#include "bake/subjects.h"
#include "base/usage.h"
#include "gltf/add_points.h"
#include "gltf/write_anew.h"
#include "scumble/bake.h"

namespace scumble {

namespace {

// Of a splat's radius: the deviation in its plane, at which a Gaussian covers about what the brush does; how
// thin it is across that; and how far the next one is, along the stroke.
constexpr float kDeviation = 0.5f, kThin = 0.06f, kApart = 0.5f;

gltf::Gaussian gaussianOf(const bake::Splat& splat) {
  // Along the stroke, across it, and where the brush faced.
  const glm::vec3 along = splat.along;
  glm::vec3 facing = splat.facing - glm::dot(splat.facing, along) * along;
  if (glm::length(facing) < 1e-3f)
    facing = glm::cross(along, std::abs(along.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0));
  facing = glm::normalize(facing);
  gltf::Gaussian gaussian;
  gaussian.position = splat.position;
  gaussian.rotation = glm::normalize(glm::quat_cast(glm::mat3(along, glm::cross(facing, along), facing)));
  gaussian.deviations = glm::max(splat.radius * glm::vec3(kDeviation, kDeviation, kThin), glm::vec3(1e-12f));
  gaussian.color = splat.root * splat.root;
  gaussian.opacity = splat.opacity;
  return gaussian;
}

bool isGltf(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return ending == ".glb" || ending == ".gltf";
}

}  // namespace

Result<PointsReport> writePoints(const std::string& path, const std::string& out,
                                 const PointsOptions& options) {
  SceneOptions sceneOptions;
  sceneOptions.allowOutside = options.allowOutside;
  sceneOptions.threads = options.threads;
  const Result<Scene> scene = Scene::load(path, sceneOptions);
  if (!scene) return scene.error();
  if (std::filesystem::path(path).extension() == ".json")
    return usage("a world cannot be written anew", "write the points of its scenes one by one");
  PointsReport report;
  report.warnings = scene->warnings();
  const Status made = gltf::guarded(path, "writing points", "paint it with fewer splats", [&]() -> Status {
    const std::shared_ptr<const scene::Painting> painting = bake::paintingInWorld(scene->data());
    if (painting->strokes.empty())
      return Error{
          ErrorKind::unusableFile, path, 0, "", "has no strokes", "paint it first: scumble paint " + path};
    BakeOptions bake;
    bake.threads = options.threads;
    std::vector<gltf::Gaussian> gaussians;
    for (const bake::Splat& splat : bake::splatsOf(*painting, bake, kApart))
      gaussians.push_back(gaussianOf(splat));
    report.points = gaussians.size();
    scene::ImportWarnings warnings;
    const std::vector<uint8_t> file =
        isGltf(path) ? gltf::withGaussians(path, sceneOptions, gaussians, scene->origin(), warnings)
                     : gltf::gaussiansAlone(scene->data().name, gaussians, scene->origin());
    gltf::addNew(report.warnings, warnings, path);
    return gltf::putWhole(out, file);
  });
  if (!made) return made.error();
  return report;
}

}  // namespace scumble
