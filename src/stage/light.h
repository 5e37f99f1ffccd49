// The key light: where it comes from, and the light space of its shadow map.
#pragma once

#include <span>

#include "look/look_data.h"
#include "scene/scene_data.h"
#include "shading/frame.shared.h"

namespace scumble::stage {

#define PARAMS_STRUCT LightParams
#define PARAMS_FILE "stage/light.params"
#define PARAMS_PATH "light"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

// The key light: xyz - w * p points from a place p of the world to it; w is 1 where it is a lamp, and 0 where
// it is endlessly far away. Depends on scene, look and time, not on the views.
// `world`, `shown`: of the nodes at the time; a light on one that is not shown does not shine.
glm::vec4 keyLight(const scene::SceneData& scene, const LightParams& params,
                   const std::vector<glm::dmat4>& world, const std::vector<bool>& shown);
// Unit vector towards it from the middle of the scene.
glm::vec3 keyLightDirection(const scene::SceneData& scene, const LightParams& params,
                            const std::vector<glm::dmat4>& world, const std::vector<bool>& shown);

// The azimuth and elevation of a light from the look that comes from a direction of unit length.
glm::vec2 keyLightAngles(const scene::SceneData& scene, const glm::vec3& towardsLight);

// How many point and spot lights nodes carry, of those that are used.
size_t punctualLightCount(const scene::SceneData& scene);
// Those that shine at a time, in the order of nodes; none where the look turns them off.
std::vector<shared::PunctualLight> punctualLights(const scene::SceneData& scene, const LightParams& params,
                                                  const std::vector<glm::dmat4>& world,
                                                  const std::vector<bool>& shown, float sceneRadius);

constexpr uint32_t kShadowMapSize = 2048;  // texels

// Part of the shadow map that lies evenly over the casters, whatever the sigmoid's strength: no place is
// coarser than that, so that neither shadows far from the viewer nor the bias against self-shadowing of large
// receivers, whose corners lie there, run away.
constexpr float kEvenShare = 0.25f;

// Fills the light's part of the frame's uniforms. `casters`: boxes of what casts shadows, world; `viewer`:
// where the map is to be finest (world).
void setLightSpace(shared::FrameUniforms& uniforms, std::span<const scene::Bounds> casters,
                   const LightParams& params, const glm::vec3& viewer);

}  // namespace scumble::stage
