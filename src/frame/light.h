// The key light: where it comes from, and the light space of its shadow map.
#pragma once

#include "frame/scene_on_gpu.h"
#include "look/look_data.h"

namespace scumble::frame {

#define PARAMS_STRUCT LightParams
#define PARAMS_FILE "frame/light.params"
#define PARAMS_PATH "light"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

// Unit vector towards the key light, in the world. Depends on scene, look and time, not on the views.
// `world`: the nodes' matrices at the time.
glm::vec3 keyLightDirection(const scene::SceneData& scene, const LightParams& params,
                            const std::vector<glm::mat4>& world);

// How many point and spot lights nodes carry, of those that are used.
size_t punctualLightCount(const scene::SceneData& scene);
// Those lights at a time, in the order of nodes; none where the look turns them off.
std::vector<shared::PunctualLight> punctualLights(const scene::SceneData& scene, const LightParams& params,
                                                  const std::vector<glm::mat4>& world, float sceneRadius);

// Fills the light's part of the frame's uniforms. `viewer`: where the map is to be finest (world).
void setLightSpace(shared::FrameUniforms& uniforms, const SceneOnGpu& scene, const LightParams& params,
                   const glm::vec3& viewer);

}  // namespace scumble::frame
