#ifndef SCUMBLE_LIMIT_SHARED_H
#define SCUMBLE_LIMIT_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN
const int kMaxPaletteColors = 16;
struct LimitUniforms {
  float amount;
  float dither, skyDither;  // how much of the way from one colour to another marks cover
  float lightness;          // factor on OKLab's L in everything below
  float softness;           // pixels
  int driftReach;           // pixels over which colours on surfaces must drift to have marks
  vec2 skyShift;            // copies
  vec2 skyTiles;            // copies of that pattern around the horizon, and up a radian
  float skyLod;
  float skySlope;  // of the marks there, of that way a pixel
  // OKLab with its L multiplied by `lightness`; the last one repeated to the end.
  vec3 colors[kMaxPaletteColors];
};
SHARED_END
#endif
