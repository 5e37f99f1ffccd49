#include "stage/light.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "scene/seen.h"
#include "stage/framing.h"

namespace scumble::stage {

namespace {

// Azimuth is measured from the default view, so that "from the left" means the same for every scene.
float zeroAzimuth(const scene::SceneData& scene) {
  const glm::vec3 eye = defaultEyeDirection(scene);
  return std::atan2(eye.x, eye.z);
}

}  // namespace

namespace {

bool isPunctual(const scene::SceneData& scene, const scene::Node& node) {
  return node.light >= 0 && scene.lights[size_t(node.light)].kind != scene::LightKind::directional;
}

// Place of a lamp that stands outside of what it lights, where a scene has no other one: its key light.
std::optional<glm::vec3> onlyLamp(const scene::SceneData& scene, const std::vector<glm::dmat4>& world,
                                  const std::vector<bool>& shown) {
  std::optional<glm::vec3> only;
  for (size_t n = 0; n < scene.nodes.size(); ++n) {
    if (!shown[n] || scene.nodes[n].light < 0) continue;
    if (only || !isPunctual(scene, scene.nodes[n]) ||
        !(scene.lights[size_t(scene.nodes[n].light)].intensity > 0))
      return std::nullopt;
    only = glm::vec3(world[n][3]);
  }
  if (!only || scene.bounds.empty || !(glm::distance(*only, scene.bounds.center()) > scene.bounds.radius()))
    return std::nullopt;
  return only;
}

}  // namespace

glm::vec4 keyLight(const scene::SceneData& scene, const LightParams& params,
                   const std::vector<glm::dmat4>& world, const std::vector<bool>& shown) {
  if (params.source == 0) {
    for (size_t n = 0; n < scene.nodes.size(); ++n) {
      const int light = scene.nodes[n].light;
      if (light < 0 || !shown[n] || scene.lights[size_t(light)].kind != scene::LightKind::directional)
        continue;
      const glm::vec3 towards(world[n][2]);  // lights shine along -Z
      if (glm::length(towards) > 1e-12f) return {glm::normalize(towards), 0};
    }
    if (const std::optional<glm::vec3> lamp = onlyLamp(scene, world, shown)) return {*lamp, 1};
  }
  const float azimuth = zeroAzimuth(scene) + glm::radians(params.azimuth);
  const float elevation = glm::radians(params.elevation);
  return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
          std::cos(azimuth) * std::cos(elevation), 0};
}

glm::vec3 keyLightDirection(const scene::SceneData& scene, const LightParams& params,
                            const std::vector<glm::dmat4>& world, const std::vector<bool>& shown) {
  const glm::vec4 light = keyLight(scene, params, world, shown);
  return light.w > 0 ? glm::normalize(glm::vec3(light) - scene.bounds.center()) : glm::vec3(light);
}

glm::vec2 keyLightAngles(const scene::SceneData& scene, const glm::vec3& towardsLight) {
  const look::ParamBlock& block = LightParams::block();
  const auto elevation = std::find_if(block.rows.begin(), block.rows.end(), [](const look::ParamRow& row) {
    return std::string_view(row.name) == "elevation";
  });
  const float height = glm::degrees(std::asin(std::clamp(towardsLight.y, -1.0f, 1.0f)));
  const float around = std::atan2(towardsLight.x, towardsLight.z) - zeroAzimuth(scene);
  return {glm::degrees(std::remainder(around, 2 * 3.14159265358979f)),
          std::clamp(height, float(elevation->min), float(elevation->max))};
}

size_t punctualLightCount(const scene::SceneData& scene) {
  const auto count = std::count_if(scene.nodes.begin(), scene.nodes.end(),
                                   [&](const scene::Node& node) { return isPunctual(scene, node); });
  return std::min(size_t(count), scene::kMaxPunctualLights);
}

std::vector<shared::PunctualLight> punctualLights(const scene::SceneData& scene, const LightParams& params,
                                                  const std::vector<glm::dmat4>& world,
                                                  const std::vector<bool>& shown, float sceneRadius) {
  std::vector<shared::PunctualLight> lights;
  if (params.punctual <= 0) return lights;
  std::vector<double> strengths;
  double sum = 0;
  const std::vector<bool> everShown = scene::everShownNodes(scene);
  size_t used = 0;
  for (size_t n = 0; n < scene.nodes.size() && used < scene::kMaxPunctualLights; ++n) {
    if (!isPunctual(scene, scene.nodes[n])) continue;
    ++used;
    const scene::Light& light = scene.lights[size_t(scene.nodes[n].light)];
    // One that goes out for a while leaves the others as they are.
    if (everShown[n]) sum += light.intensity;
    if (!shown[n]) continue;
    const glm::mat4 m(world[n]);
    shared::PunctualLight out{};
    out.position = m[3];
    strengths.push_back(double(params.punctual) * double(light.intensity));
    const float length = glm::length(glm::vec3(m[2]));
    out.direction = length > 1e-12f ? glm::vec3(m[2]) / -length : glm::vec3(0, 0, -1);
    out.inverseRangeSquared = light.range > 0 ? 1 / (light.range * light.range) : 0.0f;
    out.coneOffset = 1;
    if (light.kind == scene::LightKind::spot) {
      // As the extension's own formula has it.
      out.coneScale = 1 / std::max(0.001f, std::cos(light.innerCone) - std::cos(light.outerCone));
      out.coneOffset = -std::cos(light.outerCone) * out.coneScale;
    }
    lights.push_back(out);
  }
  // Files give anything from one candela to thousands. All lights in one place would turn what is nearer than
  // so many of the scene's radii from shadow (below a half) to light.
  constexpr float kReach = 0.4f;
  const float reach = kReach * sceneRadius;
  const double unit = params.punctualUnit == 0 && sum > 0 ? 0.5 * reach * reach / sum : 1;
  // Finite also after shaders multiply it.
  constexpr double kMost = 1e20;
  for (size_t i = 0; i < lights.size(); ++i) lights[i].strength = float(std::min(strengths[i] * unit, kMost));
  return lights;
}

void setLightSpace(shared::FrameUniforms& uniforms, std::span<const scene::Bounds> casters,
                   const LightParams& params, const glm::vec3& viewer) {
  const glm::vec3 away = -uniforms.toLight;
  const glm::vec3 up = std::abs(away.y) > 0.99f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  const glm::vec3 right = glm::normalize(glm::cross(away, up)), above = glm::cross(right, away);
  // Clip space's y points down; a light space that follows it keeps the winding, so that single-sided sheets
  // cast their shadows with the side that faces the light.
  const glm::mat3 toLightAxes = glm::transpose(glm::mat3(right, -above, away));

  // All corners: each axis of theirs is a sum of one product with either side of the box for x, y and z, and
  // sums are largest where their parts are.
  scene::Bounds box;
  for (const scene::Bounds& reach : casters) {
    glm::vec3 low(0.0f), high(0.0f);
    for (int i = 0; i < 3; ++i) {
      const glm::vec3 a = toLightAxes[i] * reach.min[i], b = toLightAxes[i] * reach.max[i];
      low += glm::min(a, b), high += glm::max(a, b);
    }
    box.add(scene::Bounds{low, high, false});
  }
  if (box.empty) box.add(glm::vec3(0.0f));
  // A margin of one percent, and no flat box.
  const glm::vec3 half = 0.505f * (box.max - box.min) + 1e-4f * uniforms.sceneRadius;
  const glm::vec3 center = box.center();
  // x, y to [-1, 1], z to [0, 1].
  glm::mat4 scale(1.0f);
  scale[0][0] = 1 / half.x, scale[1][1] = 1 / half.y, scale[2][2] = 0.5f / half.z;
  scale[3] = glm::vec4(-center.x / half.x, -center.y / half.y, 0.5f - 0.5f * center.z / half.z, 1);
  uniforms.worldToLight = scale * glm::mat4(toLightAxes);
  uniforms.lightToWorldScale = {half.x, half.y, 2 * half.z};
  uniforms.shadowTexel = 2.0f / float(kShadowMapSize);
  // A strength of nothing is a sigmoid's straight middle, wherever the viewer is: the map stays as it is.
  uniforms.shadowWarp = std::max(params.shadowWarp, 1e-3f);
  const glm::vec3 focus(uniforms.worldToLight * glm::vec4(viewer, 1));
  uniforms.shadowCenter = params.shadowWarp > 0 ? glm::clamp(glm::vec2(focus), -1.0f, 1.0f) : glm::vec2(0.0f);
  const auto sigmoid = [](const glm::vec2& t) { return t / glm::sqrt(1.0f + t * t); };
  const glm::vec2 low = sigmoid(uniforms.shadowWarp * (-1.0f - uniforms.shadowCenter));
  const glm::vec2 high = sigmoid(uniforms.shadowWarp * (1.0f - uniforms.shadowCenter));
  uniforms.shadowScale = (1 - kEvenShare) / (high - low);
  uniforms.shadowEven = 0.5f * kEvenShare / uniforms.shadowWarp;
  uniforms.shadowShift = -uniforms.shadowScale * low + kEvenShare * (0.5f + 0.5f * uniforms.shadowCenter);
}

}  // namespace scumble::stage
