// Where in the world that lies which a look places.
#include "scumble/placement.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "base/usage.h"
#include "scene/find_node.h"
#include "scene/posed_bounds.h"
#include "stage/camera.h"
#include "stage/framing.h"
#include "stage/light.h"
#include "stage/playing.h"

namespace scumble {

using namespace stage;

namespace {

Error noScene() {
  return usage("the scene is empty", "load one with Scene::load");
}

// Some, once its clips are there: of a node that is.
glm::dmat4 worldOf(const scene::SceneData& scene, int node, const look::LookData& now, double time) {
  return glm::translate(glm::dmat4(1.0), scene.origin) *
         scene::worldAt(scene, playedClips(scene, now), size_t(node), time);
}

}  // namespace

Result<glm::dmat4> nodeToWorld(const Scene& scene, const std::string& node, const Look& look, double time) {
  if (scene.empty()) return noScene();
  if (node.empty()) return glm::dmat4(1.0);
  const int found = scene::findNode(scene.data(), node);
  if (found < 0) return usage("the scene has no node '" + node + "'", "`scumble info` lists its nodes");
  return worldOf(scene.data(), found, look.data().at(time), time);
}

Result<glm::dmat4> cameraShiftToWorld(const Scene& scene, const Look& look, double time) {
  if (scene.empty()) return noScene();
  const look::LookData now = look.data().at(time);
  const int node = scene::findNode(scene.data(), now.text(now.get<CameraParams>().target));
  if (node >= 0) return worldOf(scene.data(), node, now, time);
  const scene::Bounds bounds = scene::playedBounds(scene.data(), everPlayed(scene.data(), look.data()));
  return glm::translate(glm::dmat4(1.0), scene.data().origin + glm::dvec3(bounds.center()));
}

Result<glm::vec3> towardsKeyLight(const Scene& scene, const Look& look, double time) {
  if (scene.empty()) return noScene();
  const look::LookData now = look.data().at(time);
  const scene::Pose pose = scene::poseAt(scene.data(), playedClips(scene.data(), now), time);
  return keyLightDirection(scene.data(), now.get<LightParams>(), pose.world, pose.shown);
}

Result<glm::vec2> keyLightAngles(const Scene& scene, const glm::vec3& towardsLight) {
  if (scene.empty()) return noScene();
  const float length = glm::length(towardsLight);
  if (!(length > 0 && std::isfinite(length)))
    return usage("this is no direction", "give a vector that has a length");
  return keyLightAngles(scene.data(), towardsLight / length);
}

}  // namespace scumble
