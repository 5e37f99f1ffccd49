// Lit and shadowed colours mixed by the final shadow, in the air, over the sky (paper 000, Color Pass).
#pragma once

#include "frame/pass.h"

namespace scumble::passes {

#define PARAMS_STRUCT BackgroundParams
#define PARAMS_FILE "passes/color/color.params"
#define PARAMS_PATH "background"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

// What the final shadow tells of how it is to be mixed.
struct ShadowMix {
  glm::vec3 glowColor{1.0f};
  float glowColorAmount = 0;
  bool mixesValues = false;  // in equal parts of value, not of light
};
using ShadowMixOf = ShadowMix (*)(const look::LookData& look);
std::unique_ptr<frame::Pass> makeColor(frame::Layer layer, ShadowMixOf shadowMix);

}  // namespace scumble::passes
