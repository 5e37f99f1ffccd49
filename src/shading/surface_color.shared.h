// Colours of surfaces in light, shadow and air, and of the sky: what they are made with.
#ifndef SCUMBLE_SURFACE_COLOR_SHARED_H
#define SCUMBLE_SURFACE_COLOR_SHARED_H
#include "shared_types.h"

SHARED_BEGIN
// For a specialisation constant: what there is. Sky, lit and dark are tiles that need not look; in mixed ones
// pixels may have samples of several surfaces.
const int kPartAll = 0, kPartSky = 1, kPartLit = 2, kPartDark = 3, kPartMixed = 4;

struct SurfaceColors {
  vec3 horizon;
  float height;  // sine of the elevation at which the sky has its upper colour
  vec3 zenith;
  float air;               // how far distant things dissolve into the horizon
  float airStart, airEnd;  // metres along the view axis
  float transparent;       // 1: alpha 0 where nothing is
  float skyTones;          // steps from the horizon's colour to the upper one; 0: the sky goes over evenly
  float skyStrokes;        // how far strokes reach into other tones, tones
  float skyStrokeSize;     // pixels
  float skyEven;           // tones that the sky goes through in a radian, at most
  vec3 glowColor;          // of the inner glow
  float glowColorAmount;   // against the surface's colour in light
  float deepGlow;          // as the light has it, deep in the dark
  float mixesValues;       // 1: lit and shadowed are mixed in equal parts of value, else of light
};
SHARED_END
#endif
