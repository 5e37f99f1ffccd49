#ifndef SCUMBLE_COLOR_SHARED_H
#define SCUMBLE_COLOR_SHARED_H
#include "../../shading/shared_types.h"
#ifdef __cplusplus
#include "passes/color/color_knobs.h"
#endif

SHARED_BEGIN
#ifdef __cplusplus
using passes::BackgroundParams;
#else
struct BackgroundParams {
#include "color.params"
};
#endif

// Bindings of set 1.
const int kColorLight = 1, kColorLit = 2, kColorShadowed = 3, kColorDepth = 4;

// Specialisation constant 0: what there is. All but the first are of tiles that are plain, and need not look.
const int kPartAll = 0, kPartSky = 1, kPartLit = 2, kPartDark = 3;

struct ColorUniforms {
  BackgroundParams knobs;
  vec3 horizon;
  float height;  // sine of the elevation at which the sky has its upper colour
  vec3 zenith;
  float airStart, airEnd;  // metres along the view axis
  float transparent;       // 1: alpha 0 where nothing is
  vec3 glowColor;          // of the inner glow
  float glowColorAmount;   // against the surface's colour in light
  float deepGlow;          // as the light has it, deep in the dark
  float mixesValues;       // 1: lit and shadowed are mixed in equal parts of value, else of light
};
SHARED_END
#endif
