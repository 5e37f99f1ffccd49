#ifndef SCUMBLE_LIMIT_SHARED_H
#define SCUMBLE_LIMIT_SHARED_H
#include "../../shading/palette.shared.h"
#include "../../shading/shared_types.h"
#ifdef __cplusplus
#include "passes/limit/limit_knobs.h"
#endif

SHARED_BEGIN
#ifdef __cplusplus
using passes::LimitParams;
#else
struct LimitParams {
#include "limit.params"
};
#endif

// Bindings of set 1.
const int kLimitColor = 1, kLimitWarp = 2, kLimitDepth = 3, kLimitStrokes = 4;
const int kMendColor = 1, kMendLimited = 2;

// Binding and block for overlays.
const int kLimitOverlay = 1;
struct LimitOverlayUniforms {
  float amount, lightness;         // the knobs
  vec3 colors[kMaxPaletteColors];  // as LimitUniforms has them
};

struct LimitUniforms {
  LimitParams knobs;
  float dither, skyDither;  // how much of the way from one colour to another marks cover
  int driftReach;           // pixels over which colours on surfaces must drift to have marks
  vec2 skyShift;            // copies
  vec2 skyTiles;            // copies of that pattern around the horizon, and up a radian
  float skyLod;
  float skySlope;  // of the marks there, of that way a pixel
  // OKLab with its L multiplied by the knob `lightness`; the last one repeated to the end.
  vec3 colors[kMaxPaletteColors];
};
SHARED_END
#endif
