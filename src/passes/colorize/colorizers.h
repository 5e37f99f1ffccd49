// The colorizers of a look at a moment, where they are in the world, and what the shader reads of them.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "passes/colorize/colorize.shared.h"
#include "passes/colorize/colorize_knobs.h"
#include "scene/scene_data.h"
#include "shading/frame.shared.h"

namespace scumble::passes {

struct PlacedColorizer {
  shared::Colorizer data;
  int features = 0;  // what the shader needs for it: bits of colorize.shared.h
  bool bounded = false;
  glm::dvec3 corners[8];  // of a box around a bounded one, in the world
};

// Those that do anything, in the order of the look: neither their density is 0 nor their grading the
// identity, and the node they hang on exists and is not flat. `worlds`: matrices of the scene's nodes.
std::vector<PlacedColorizer> placeColorizers(const look::LookData& look, const scene::SceneData& scene,
                                             const std::vector<glm::dmat4>& worlds,
                                             const shared::FrameUniforms& uniforms);

// The rays of a view's pixels.
shared::SightLines sightLines(const shared::ViewUniforms& view);

}  // namespace scumble::passes
