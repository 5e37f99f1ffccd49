#include "frame/light.h"

#include <algorithm>
#include <cmath>

#include "frame/framing.h"

namespace scumble::frame {

glm::vec3 keyLightDirection(const scene::SceneData& scene, const LightParams& params,
                            const std::vector<glm::mat4>& world) {
  if (params.source == 0) {
    for (size_t n = 0; n < scene.nodes.size(); ++n) {
      const int light = scene.nodes[n].light;
      if (light < 0 || scene.lights[size_t(light)].kind != scene::LightKind::directional) continue;
      const glm::vec3 towards(world[n] * glm::vec4(0, 0, 1, 0));  // lights shine along -Z
      if (glm::length(towards) > 1e-12f) return glm::normalize(towards);
    }
  }
  // Azimuth is measured from the default view, so that "from the left" means the same for every scene.
  const glm::vec3 eye = defaultEyeDirection(scene);
  const float azimuth = std::atan2(eye.x, eye.z) + glm::radians(params.azimuth);
  const float elevation = glm::radians(params.elevation);
  return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
          std::cos(azimuth) * std::cos(elevation)};
}

void setLightSpace(shared::FrameUniforms& uniforms, const SceneOnGpu& scene, const LightParams& params,
                   const glm::vec3& viewer) {
  const glm::vec3 away = -uniforms.toLight;
  const glm::vec3 up = std::abs(away.y) > 0.99f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  const glm::vec3 right = glm::normalize(glm::cross(away, up)), above = glm::cross(right, away);
  // Clip space's y points down; a light space that follows it keeps the winding, so that single-sided sheets
  // cast their shadows with the side that faces the light.
  const glm::mat3 toLightAxes = glm::transpose(glm::mat3(right, -above, away));

  scene::Bounds box;
  for (const Draw& draw : scene.draws()) {
    if (!draw.casts) continue;
    // What a thing reaches at any time, so that the map's texels stay where they are from frame to frame.
    scene::Bounds reach = draw.reach;
    reach.add(draw.bounds);
    for (int corner = 0; corner < 8; ++corner)
      box.add(toLightAxes * glm::vec3(corner & 1 ? reach.max.x : reach.min.x,
                                      corner & 2 ? reach.max.y : reach.min.y,
                                      corner & 4 ? reach.max.z : reach.min.z));
  }
  if (box.empty) box.add(glm::vec3(0.0f));
  // A margin of one percent, and no flat box.
  const glm::vec3 half = 0.505f * (box.max - box.min) + 1e-4f * std::max(scene.bounds().radius(), 1e-6f);
  const glm::vec3 center = box.center();
  // x, y to [-1, 1], z to [0, 1].
  glm::mat4 scale(1.0f);
  scale[0][0] = 1 / half.x, scale[1][1] = 1 / half.y, scale[2][2] = 0.5f / half.z;
  scale[3] = glm::vec4(-center.x / half.x, -center.y / half.y, 0.5f - 0.5f * center.z / half.z, 1);
  uniforms.worldToLight = scale * glm::mat4(toLightAxes);
  uniforms.lightToWorldScale = {half.x, half.y, 2 * half.z};
  uniforms.shadowTexel = 2.0f / float(kShadowMapSize);
  // A strength of nothing is a sigmoid's straight middle.
  uniforms.shadowWarp = std::max(params.shadowWarp, 1e-3f);
  const glm::vec3 focus(uniforms.worldToLight * glm::vec4(viewer, 1));
  uniforms.shadowCenter = glm::clamp(glm::vec2(focus), -1.0f, 1.0f);
  const auto sigmoid = [](const glm::vec2& t) { return t / glm::sqrt(1.0f + t * t); };
  const glm::vec2 low = sigmoid(uniforms.shadowWarp * (-1.0f - uniforms.shadowCenter));
  const glm::vec2 high = sigmoid(uniforms.shadowWarp * (1.0f - uniforms.shadowCenter));
  uniforms.shadowScale = 1.0f / (high - low);
  uniforms.shadowShift = -uniforms.shadowScale * low;
}

}  // namespace scumble::frame
