// From where a frame is seen: what the caller, the look and the scene say of it, in this order.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "base/usage.h"
#include "scene/find_node.h"
#include "scene/posed_bounds.h"
#include "scene/prepare_mesh.h"
#include "scene/seen.h"
#include "scene/surroundings.h"
#include "scumble/view.h"
#include "stage/camera.h"
#include "stage/framing.h"
#include "stage/playing.h"

namespace scumble {

using scene::SceneData;

glm::mat4 perspectiveProjection(float verticalFov, float aspect, float near) {
  const float f = 1.0f / std::tan(0.5f * verticalFov);
  glm::mat4 p(0.0f);
  p[0][0] = f / aspect;
  p[1][1] = -f;  // y down
  p[2][3] = -1;
  p[3][2] = near;
  return p;
}

glm::mat4 orthographicProjection(float halfHeight, float aspect, float near, float far) {
  glm::mat4 p(1.0f);
  p[0][0] = 1 / (halfHeight * aspect);
  p[1][1] = -1 / halfHeight;
  p[2][2] = 1 / (far - near);  // z is negative in front: 1 at near, 0 at far
  p[3][2] = far / (far - near);
  return p;
}

glm::dmat4 worldToEyeOf(const View& view) {
  return glm::dmat4(view.worldToEye) * glm::translate(glm::dmat4(1.0), -view.origin);
}

void setWorldToEye(View& view, const glm::dmat4& worldToEye) {
  constexpr double kNear = 500;  // metres, which single precision tells to 0.03 mm
  const glm::dvec3 eye(glm::inverse(worldToEye)[3]);
  const bool isFar = std::max({std::abs(eye.x), std::abs(eye.y), std::abs(eye.z)}) > kNear;
  view.origin = isFar ? glm::round(eye) : glm::dvec3(0.0);
  view.worldToEye = worldToEye * glm::translate(glm::dmat4(1.0), view.origin);
}

namespace {

using namespace stage;

// Turns and places beyond which floats tell neighbouring ones no longer apart.
constexpr double kMostDegrees = 36000, kMostRadii = 1e6, kMostMetres = scene::kMaxCoordinate, kMostIpd = 1e6;

Status checkRanges(const Viewpoint& viewpoint, float ipd) {
  const auto isBeyond = [](double number, double most) { return !(std::abs(number) <= most); };
  if (isBeyond(viewpoint.roll.value_or(0), kMostDegrees))
    return usage("the roll is out of range", "it is in degrees, up to a hundred turns");
  if (!(ipd >= 0 && ipd <= kMostIpd))
    return usage("the distance between the eyes (ipd) is out of range", "it is in metres, 0 to a million");
  if (isBeyond(viewpoint.azimuth, kMostDegrees))
    return usage("the orbit's azimuth is out of range", "it is in degrees, up to a hundred turns");
  if (isBeyond(viewpoint.elevation, 90))
    return usage("the orbit's elevation is out of range", "it is -90 to 90 degrees");
  if (viewpoint.distance && !(*viewpoint.distance > 0 && *viewpoint.distance <= kMostRadii))
    return usage("the orbit's distance is out of range", "it is in scene radii, above 0 and up to a million");
  for (const auto& point : {viewpoint.eye, viewpoint.target})
    for (int axis = 0; axis < 3; ++axis)
      if (point && isBeyond((*point)[axis], kMostMetres))
        return usage("the eye or its target is out of range", "they are in metres, up to 1e15");
  return Done{};
}

// Index of the camera with this name, or with this number.
std::optional<size_t> findCamera(const SceneData& scene, const std::string& name) {
  for (size_t i = 0; i < scene.cameras.size(); ++i)
    if (scene.cameras[i].name == name) return i;
  if (!name.empty() && name.size() < 7 &&
      std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; }))
    if (const size_t number = size_t(std::stoul(name)); number < scene.cameras.size()) return number;
  return std::nullopt;
}

// Who says where the camera stands.
enum class Standpoint { byHand, orbitByHand, lookOrbit, lookEye, sceneCamera, framing };

// What a look's camera.mode `auto` means.
Standpoint ofLook(const look::LookData& look, const CameraParams& camera, bool hasCameras) {
  enum Mode { kAuto, kScene, kOrbit, kEye };
  const auto sets = [&](std::initializer_list<const char*> rows) {
    return std::any_of(rows.begin(), rows.end(),
                       [&](const char* row) { return look.settingOf(CameraParams::block(), row); });
  };
  int mode = camera.mode;
  if (mode == kAuto)
    mode = sets({"eye"})                                                   ? kEye
           : sets({"target", "shift", "azimuth", "elevation", "distance"}) ? kOrbit
                                                                           : kScene;
  if (mode == kOrbit) return Standpoint::lookOrbit;
  if (mode == kEye) return Standpoint::lookEye;
  return hasCameras ? Standpoint::sceneCamera : Standpoint::framing;
}

Standpoint standpointOf(const SceneData& scene, const Viewpoint& viewpoint, const look::LookData& look,
                        const CameraParams& camera) {
  if (viewpoint.eye || viewpoint.target) return Standpoint::byHand;
  if (viewpoint.turntable) return Standpoint::lookOrbit;
  if (viewpoint.orbit) return Standpoint::orbitByHand;
  if (!viewpoint.frame.empty()) return Standpoint::framing;
  if (!viewpoint.camera.empty()) return Standpoint::sceneCamera;
  return ofLook(look, camera, !scene.cameras.empty());
}

// Everything that the ways to place a camera need.
struct Shot {
  const SceneData& scene;
  const Viewpoint& viewpoint;
  const look::LookData& look;     // with its tracks
  const look::LookData& now;      // of the moment
  const CameraParams& camera;     // of the moment
  const double time;              // seconds
  const float fov, roll, aspect;  // radians, degrees
  std::vector<bool> framed = {};  // nodes: what there is to be seen
  bool isAll = true;              // of what is shown
};

// A place of the world as the scene counts.
glm::vec3 inScene(const Shot& shot, const glm::dvec3& place) {
  return place - shot.scene.origin;
}

// `azimuth`: what turns upright where it cannot be told from the direction, in degrees.
View lookAt(const Shot& shot, const glm::vec3& eye, const glm::vec3& target, float near, float azimuth = 0) {
  const glm::vec3 forward = glm::normalize(target - eye);
  glm::vec3 up(0, 1, 0);
  // Above the pole the picture's top is away from where one comes from, below it towards that.
  if (std::abs(forward.y) > 0.999f) up = (forward.y < 0 ? -1.0f : 1.0f) * orbitDirection(azimuth, 0);
  View view;
  view.worldToEye = glm::lookAt(eye, target, up);
  view.worldToEye =
      glm::rotate(glm::mat4(1.0f), glm::radians(shot.roll), glm::vec3(0, 0, 1)) * view.worldToEye;
  view.eyeToClip =
      perspectiveProjection(shot.fov, shot.aspect, std::min(near, 0.1f * glm::length(target - eye)));
  return view;
}

Result<View> fromEye(const Shot& shot, const glm::vec3& eye, const glm::vec3& target, float radius) {
  if (glm::length(target - eye) < 1e-9f * radius)
    return usage("the eye stands on its target", "move one of them");
  return lookAt(shot, eye, target, 1e-3f * radius);
}

// What there is to be seen, as points.
std::vector<glm::vec3> outlineOf(const Shot& shot) {
  return scene::playedOutline(shot.scene, shot.framed, everPlayed(shot.scene, shot.look));
}

scene::Bounds boundsOf(const Shot& shot) {
  if (shot.isAll) return scene::playedBounds(shot.scene, everPlayed(shot.scene, shot.look));
  scene::Bounds bounds;
  for (const glm::vec3& p : outlineOf(shot)) bounds.add(p);
  return bounds;
}

// Nodes that are shown at any time; where the caller names some, those of them that they are or hang below.
Result<std::vector<bool>> framedNodes(const SceneData& scene, const std::string& name) {
  std::vector<bool> shown = scene::everShownNodes(scene);
  if (name.empty()) return shown;
  const int found = scene::findNode(scene, name);
  const std::vector<bool> seen = scene::seenNodes(scene, scene::allClips(scene));
  std::vector<bool> isNamed(scene.nodes.size());
  bool isThere = false, isSeen = false;
  for (size_t n = 0; n < scene.nodes.size(); ++n) {
    const scene::Node& node = scene.nodes[n];
    isNamed[n] = int(n) == found || look::matches(name, node.name) ||
                 (node.parent >= 0 && isNamed[size_t(node.parent)]);
    isThere |= isNamed[n];
    shown[n] = shown[n] && isNamed[n];
    isSeen |= shown[n] && seen[n];
  }
  if (!isThere) return usage("the scene has no node '" + name + "'", "`scumble info` lists its nodes");
  if (!isSeen)
    return usage("nothing is to be seen of the node '" + name + "'", "name one with a mesh, or above one");
  return shown;
}

// What the look's camera looks at.
glm::vec3 targetOf(const Shot& shot, const scene::Bounds& bounds) {
  const glm::vec3 shift = shot.camera.shift;
  const int node = scene::findNode(shot.scene, shot.now.text(shot.camera.target));
  if (node < 0) return bounds.center() + shift;
  const std::vector<scene::PlayedClip> clips = playedClips(shot.scene, shot.now);
  return glm::vec3(scene::worldAt(shot.scene, clips, size_t(node), shot.time) * glm::dvec4(shift, 1.0));
}

// Around what the look's camera looks at; what the caller says of an orbit counts before what the look does.
Result<View> fromLookOrbit(const Shot& shot, const scene::Bounds& bounds, float radius) {
  const Viewpoint& by = shot.viewpoint;
  double azimuth = by.orbit ? by.azimuth : shot.camera.azimuth;
  const float elevation = by.orbit ? by.elevation : shot.camera.elevation;
  if (by.turntable) {
    // The look's own way around would not close.
    if (!by.orbit) azimuth = shot.look.at(0).get<CameraParams>().azimuth;
    if (!by.orbit && shot.scene.facesBack && !shot.look.settingOf(CameraParams::block(), "azimuth"))
      azimuth += 180;
    azimuth += 360 * std::fmod(shot.time / *by.turntable, 1.0);
  }
  const std::optional<float> radii = by.distance                ? by.distance
                                     : shot.camera.distance > 0 ? std::optional(shot.camera.distance)
                                                                : std::nullopt;
  const float distance =
      radii ? *radii * radius
            : framingDistanceAllAround(outlineOf(shot), bounds.center(), elevation, shot.fov, shot.aspect);
  const glm::vec3 target = targetOf(shot, bounds);
  const float around = float(std::remainder(azimuth, 360.0));
  return lookAt(shot, target + distance * orbitDirection(around, elevation), target, 1e-3f * radius, around);
}

Result<View> fromHand(const Shot& shot, const scene::Bounds& bounds, float radius) {
  const Viewpoint& by = shot.viewpoint;
  const glm::vec3 target = by.target ? inScene(shot, *by.target) : bounds.center();
  const glm::vec3 direction = defaultEyeDirection(shot.scene);
  const glm::vec3 eye =
      by.eye
          ? inScene(shot, *by.eye)
          : target + framingDistance(outlineOf(shot), target, direction, shot.fov, shot.aspect) * direction;
  return fromEye(shot, eye, target, radius);
}

// Around the scene's centre.
Result<View> fromOrbit(const Shot& shot, const scene::Bounds& bounds, float radius) {
  const Viewpoint& by = shot.viewpoint;
  const glm::vec3 direction = orbitDirection(by.azimuth, by.elevation), center = bounds.center();
  const float distance = by.distance
                             ? *by.distance * radius
                             : framingDistance(outlineOf(shot), center, direction, shot.fov, shot.aspect);
  return lookAt(shot, center + distance * direction, center, 1e-3f * radius, by.azimuth);
}

// Where nobody says anything.
Result<View> fromFraming(const Shot& shot, float radius) {
  const glm::vec3 direction = frontDirection(shot.scene);
  const Framing framing = framingOf(outlineOf(shot), direction, shot.fov, shot.aspect);
  const float distance = shot.viewpoint.distance ? *shot.viewpoint.distance * radius : framing.distance;
  return lookAt(shot, framing.target + distance * direction, framing.target, 1e-3f * radius,
                CameraParams().azimuth);
}

Result<View> fromSceneCamera(const Shot& shot, size_t index) {
  const scene::Camera& camera = shot.scene.cameras[index];
  View view;
  view.node = cameraNode(shot.scene, index);
  const std::vector<scene::PlayedClip> clips = playedClips(shot.scene, shot.now);
  glm::mat4 world(view.node < 0 ? glm::dmat4(1.0)
                                : scene::worldAt(shot.scene, clips, size_t(view.node), shot.time));
  // Scale in a camera's matrix means nothing.
  for (int axis = 0; axis < 3; ++axis)
    if (const float length = glm::length(glm::vec3(world[axis])); length > 1e-12f) world[axis] /= length;
  // Nor does a mirror above it: it stands where that puts it, and looks along that, and its picture is no
  // mirror's.
  if (glm::determinant(glm::mat3(world)) < 0) world[0] = -world[0];
  view.worldToEye =
      glm::rotate(glm::mat4(1.0f), glm::radians(shot.roll), glm::vec3(0, 0, 1)) * glm::inverse(world);
  const float radius = std::max(shot.scene.bounds.radius(), 1e-6f);
  if (camera.perspective) {
    const bool isTold =
        shot.viewpoint.verticalFov || shot.look.settingOf(CameraParams::block(), "fov") != nullptr;
    const float fov = isTold ? shot.fov : std::clamp(camera.verticalFov, 0.001f, 3.1f);
    view.eyeToClip = perspectiveProjection(fov, shot.aspect, std::max(camera.near, 1e-6f * radius));
  } else {
    const float far = camera.far > camera.near ? camera.far : camera.near + 100 * radius;
    view.eyeToClip = orthographicProjection(camera.halfHeight, shot.aspect, camera.near, far);
  }
  return view;
}

Result<View> viewFrom(const Shot& shot, Standpoint standpoint) {
  const SceneData& scene = shot.scene;
  if (standpoint == Standpoint::sceneCamera) {
    const std::string& name = shot.viewpoint.camera;
    const std::optional<size_t> index = name.empty() ? 0 : findCamera(scene, name);
    if (index) return fromSceneCamera(shot, *index);
    std::string names;
    for (size_t i = 0; i < scene.cameras.size(); ++i)
      names +=
          (i == 0 ? "" : ", ") + (scene.cameras[i].name.empty() ? std::to_string(i) : scene.cameras[i].name);
    return usage("the scene has no camera '" + name + "'",
                 names.empty() ? "it has none at all; use --orbit" : "it has: " + names);
  }
  const scene::Bounds bounds = boundsOf(shot);
  const float radius = std::max(bounds.radius(), 1e-6f);
  if (standpoint == Standpoint::byHand) return fromHand(shot, bounds, radius);
  if (standpoint == Standpoint::lookEye)
    return fromEye(shot, inScene(shot, glm::vec3(shot.camera.eye)), targetOf(shot, bounds), radius);
  if (standpoint == Standpoint::lookOrbit) return fromLookOrbit(shot, bounds, radius);
  if (standpoint == Standpoint::orbitByHand) return fromOrbit(shot, bounds, radius);
  return fromFraming(shot, radius);
}

}  // namespace

Result<std::vector<View>> makeViews(const Scene& scene, const Viewpoint& viewpoint, float aspect,
                                    Stereo stereo, float ipd, const Look& look, double time) {
  if (scene.empty()) return usage("the scene is empty", "load one with Scene::load");
  const look::LookData now = look.data().at(time);
  const CameraParams camera = now.get<CameraParams>();
  const float fov = glm::radians(viewpoint.verticalFov.value_or(camera.fov));
  if (!(fov > 0.001f && fov < 3.1f))
    return usage("a field of view of that size sees nothing", "use 1 to 170 degrees");
  if (!(aspect > 0)) return usage("the picture has no area", "give a size like 1280x720");
  if (const Status status = checkRanges(viewpoint, ipd); !status) return status.error();
  if (viewpoint.turntable && !(*viewpoint.turntable > 0 && std::isfinite(*viewpoint.turntable)))
    return usage("a turn takes no such time", "give it in seconds, above 0");

  Result<std::vector<bool>> framed = framedNodes(scene.data(), viewpoint.frame);
  if (!framed) return framed.error();
  Shot shot{scene.data(),
            viewpoint,
            look.data(),
            now,
            camera,
            time,
            fov,
            viewpoint.roll.value_or(camera.roll),
            aspect,
            std::move(framed).value(),
            viewpoint.frame.empty()};
  const Standpoint standpoint = standpointOf(scene.data(), viewpoint, look.data(), camera);
  if (shot.isAll && standpoint != Standpoint::sceneCamera) {
    const std::vector<bool> around = scene::surroundings(scene.data());
    for (size_t n = 0; n < around.size(); ++n)
      if (around[n]) shot.framed[n] = shot.isAll = false;
  }
  Result<View> made = viewFrom(shot, standpoint);
  if (!made) return made.error();
  made->origin = scene.data().origin;
  if (stereo == Stereo::mono) return std::vector<View>{*made};
  std::vector<View> eyes(2, *made);
  for (int i = 0; i < 2; ++i)
    eyes[size_t(i)].worldToEye =
        glm::translate(glm::mat4(1.0f), glm::vec3((i == 0 ? 0.5f : -0.5f) * ipd, 0, 0)) * made->worldToEye;
  return eyes;
}

float headingOf(const View& view) {
  const glm::mat4 toWorld = glm::inverse(view.worldToEye);
  const glm::vec3 back(toWorld[2]), up(toWorld[1]);
  // Of one that looks straight down, what is up in its picture lies ahead.
  const bool isSteep = std::hypot(back.x, back.z) < 1e-3f;
  const glm::vec3 ahead = isSteep ? (back.y > 0 ? up : -up) : -back;
  return std::atan2(-ahead.x, -ahead.z);
}

std::vector<glm::dmat4> nodesToWorld(const Scene& scene, const Look& look, double time) {
  if (scene.empty()) return {};
  const std::vector<scene::PlayedClip> clips = stage::playedClips(scene.data(), look.data().at(time));
  std::vector<glm::dmat4> world = scene::poseAt(scene.data(), clips, time).world;
  for (glm::dmat4& node : world) node = glm::translate(glm::dmat4(1.0), scene.data().origin) * node;
  return world;
}

bool viewsMove(const Scene& scene, const Viewpoint& viewpoint, const Look& look) {
  if (scene.empty()) return false;
  const look::LookData& data = look.data();
  const auto isAnimated = [&](const char* row) {
    const look::Assignment* setting = data.settingOf(CameraParams::block(), row);
    return setting && setting->track;
  };
  if (isAnimated("mode") || (!viewpoint.roll && isAnimated("roll")) ||
      (!viewpoint.verticalFov && isAnimated("fov")))
    return true;
  const Standpoint standpoint = standpointOf(scene.data(), viewpoint, data, data.get<CameraParams>());
  return standpoint == Standpoint::sceneCamera || standpoint == Standpoint::lookOrbit ||
         standpoint == Standpoint::lookEye;
}

}  // namespace scumble
