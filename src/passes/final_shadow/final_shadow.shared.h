#ifndef SCUMBLE_FINAL_SHADOW_SHARED_H
#define SCUMBLE_FINAL_SHADOW_SHARED_H
#include "../../shading/shared_types.h"
#ifdef __cplusplus
#include "passes/final_shadow/final_shadow_knobs.h"
#endif

SHARED_BEGIN
#ifdef __cplusplus
using passes::FinalShadowParams;
#else
struct FinalShadowParams {
#include "final_shadow.params"
};
#endif

// Bindings of set 1.
const int kFinalShadowBlurred = 1, kFinalShadowShadow = 2, kFinalShadowDepth = 3, kFinalShadowWarp = 4,
          kFinalShadowSamples = 5, kFinalShadowDepthSamples = 6;

// Specialisation constant 2: what the light is made of.
const int kLightBlurred = 1, kLightSharp = 2, kLightMarks = 4;
const int kLightSeveral = 8;  // samples of a pixel may differ

struct FinalShadowUniforms {
  FinalShadowParams knobs;
  // Of each edge between light and shadow: the amount of light, and its share of the way (0 where there are
  // fewer edges).
  vec4 stepThresholds, stepShares;
  float darkestEdge;     // amount of light
  float glowReach;       // how far below it the glow is full, as a part of it
  float depthSharpness;  // as the blur's
  float blurAmount;      // 1; less where the knob asks for less roundness than the blur can be small
};
SHARED_END
#endif
