#ifndef SCUMBLE_FINAL_SHADOW_SHARED_H
#define SCUMBLE_FINAL_SHADOW_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN
struct FinalShadowUniforms {
  // Of each edge between light and shadow: the amount of light, and its share of the way (0 where there are
  // fewer edges).
  vec4 stepThresholds, stepShares;
  float softness;  // pixels
  float innerGlow;
  float darkestEdge, brightestEdge;  // amounts of light
  float glowReach;                   // how far below it the glow is full, as a part of it
  float indication;
  float dither;
  float depthSharpness;  // as the blur's
  float blurAmount;      // 1; less where the knob asks for less roundness than the blur can be small
};
SHARED_END
#endif
