// Cameras and KHR_lights_punctual. Both are optional: one that is broken is left out with a warning.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "gltf/import.h"

namespace scumble::gltf {

namespace {

float positive(const JsonView& json, const char* key) {
  const float value = json.number(key, 0.0f);
  if (!(value > 0.0f)) json.failAt(key, "is not above zero");
  return value;
}

Camera readCamera(const JsonView& json) {
  Camera camera;
  camera.name = json.text("name");
  const std::string type = json.text("type");
  camera.perspective = type == "perspective";
  const JsonView lens = json.object(camera.perspective ? "perspective" : "orthographic");
  if (!lens || (!camera.perspective && type != "orthographic"))
    json.failAt("type", "is not a known kind of camera");
  if (camera.perspective) {
    camera.verticalFov = positive(lens, "yfov");
    if (camera.verticalFov > 3.1f) lens.failAt("yfov", "is not below half a turn");
    if (lens.has("aspectRatio")) camera.aspect = positive(lens, "aspectRatio");
    camera.near = positive(lens, "znear");
    if (lens.has("zfar")) camera.far = positive(lens, "zfar");
    if (camera.far != 0.0f && camera.far <= camera.near) lens.failAt("zfar", "is not beyond znear");
  } else {
    // Some exporters mirror an image by a negative magnification; the size is what counts.
    camera.halfHeight = std::abs(lens.number("ymag", 0.0f));
    if (!(camera.halfHeight > 0.0f)) lens.failAt("ymag", "is zero");
    const float halfWidth = std::abs(lens.number("xmag", camera.halfHeight));
    camera.aspect = halfWidth > 0.0f ? halfWidth / camera.halfHeight : 0.0f;
    if (!std::isfinite(camera.aspect)) camera.aspect = 0.0f;
    camera.near = lens.number("znear", 0.0f);
    camera.far = positive(lens, "zfar");
    if (camera.near < 0.0f || camera.far <= camera.near) lens.failAt("zfar", "is not beyond znear");
  }
  return camera;
}

Light readLight(const JsonView& json) {
  Light light;
  light.name = json.text("name");
  const std::string type = json.text("type");
  if (type == "point")
    light.kind = LightKind::point;
  else if (type == "spot")
    light.kind = LightKind::spot;
  else if (type != "directional")
    json.failAt("type", "is not a known kind of light");
  json.numbers("color", &light.color.x, 3);
  light.color = glm::max(light.color, glm::vec3(0.0f));
  light.intensity = std::max(0.0f, json.number("intensity", 1.0f));
  light.range = json.has("range") ? positive(json, "range") : 0.0f;
  if (light.kind == LightKind::spot) {
    const JsonView spot = json.object("spot");
    light.innerCone = spot ? spot.number("innerConeAngle", 0.0f) : 0.0f;
    light.outerCone =
        spot ? spot.number("outerConeAngle", glm::quarter_pi<float>()) : glm::quarter_pi<float>();
    light.outerCone = std::clamp(light.outerCone, 1e-4f, glm::half_pi<float>());
    light.innerCone = std::clamp(light.innerCone, 0.0f, light.outerCone);
  }
  return light;
}

// Reads those elements of a list that the map marks; the map then holds their numbers.
template <class T, class Read>
void readMarked(const Import& import, const JsonView& list, std::vector<int>& map, std::vector<T>& out,
                const char* what, const Read& read) {
  for (size_t i = 0; i < map.size(); ++i) {
    if (map[i] < 0) continue;
    map[i] = -1;
    try {
      out.push_back(read(list.at(i)));
      map[i] = static_cast<int>(out.size()) - 1;
    } catch (const ImportFailure& failure) {
      warnIgnored(import.warnings, failure, what);
    }
  }
}

}  // namespace

void readCamerasAndLights(const Import& import, SceneData& scene, Maps& maps) {
  readMarked(import, import.document.list("cameras"), maps.cameras, scene.cameras, "a camera is", readCamera);
  if (!maps.lights.empty())
    readMarked(import, import.document.root().extension("KHR_lights_punctual").list("lights"), maps.lights,
               scene.lights, "a light is", readLight);
  for (Node& node : scene.nodes) {
    if (node.camera >= 0) node.camera = maps.cameras[node.camera];
    if (node.light >= 0) node.light = maps.lights[node.light];
    // People know a camera by the object that carries it, where it has no name of its own.
    if (node.camera >= 0 && scene.cameras[node.camera].name.empty())
      scene.cameras[node.camera].name = node.name;
    if (node.light >= 0 && scene.lights[node.light].name.empty()) scene.lights[node.light].name = node.name;
  }
  const auto punctual = std::count_if(scene.nodes.begin(), scene.nodes.end(), [&](const Node& node) {
    return node.light >= 0 && scene.lights[node.light].kind != LightKind::directional;
  });
  if (static_cast<size_t>(punctual) > kMaxPunctualLights)
    import.warnings.add("/nodes", "there are more than " + std::to_string(kMaxPunctualLights) +
                                      " point and spot lights; those after them are not used");
}

}  // namespace scumble::gltf
