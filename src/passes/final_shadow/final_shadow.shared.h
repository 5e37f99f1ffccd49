#ifndef SCUMBLE_FINAL_SHADOW_SHARED_H
#define SCUMBLE_FINAL_SHADOW_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN
struct FinalShadowUniforms {
  float threshold;
  float softness;  // pixels
  float innerGlow;
  float indication;
  float dither;
  int indicationSteps;
  float depthSharpness;  // as the blur's
  float blurAmount;      // 1; less where the knob asks for less roundness than the blur can be small
};
SHARED_END
#endif
