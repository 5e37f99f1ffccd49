// A glTF written anew with a cloud of Gaussians instead of strokes, as one .glb (KHR_gaussian_splatting).
#pragma once

#include <string>
#include <vector>

#include "scene/import_warnings.h"
#include "scene/scene_data.h"
#include "scumble/scene.h"

namespace scumble::gltf {

// An ellipsoid that fades from its middle.
struct Gaussian {
  glm::vec3 position{0.0f};                    // metres, world
  glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};  // of its axes, unit length
  glm::vec3 deviations{1.0f};                  // along its axes, metres; above 0
  glm::vec3 color{1.0f};                       // linear, 0 to 1
  float opacity = 1;                           // in its middle
};

// All of the file but its strokes and its clips; what it shows stands where it stands at rest. `origin`: the
// place in the world from which positions count. Fails with scene::ImportFailure.
std::vector<uint8_t> withGaussians(const std::string& path, const SceneOptions& options,
                                   const std::vector<Gaussian>& gaussians, const glm::dvec3& origin,
                                   scene::ImportWarnings& warnings);

// The cloud alone.
std::vector<uint8_t> gaussiansAlone(const std::string& name, const std::vector<Gaussian>& gaussians,
                                    const glm::dvec3& origin);

}  // namespace scumble::gltf
