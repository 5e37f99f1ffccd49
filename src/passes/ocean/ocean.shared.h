#ifndef SCUMBLE_OCEAN_PAINT_SHARED_H
#define SCUMBLE_OCEAN_PAINT_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN

// What the image step is specialised to.
const int kOceanNext = 1;  // colours go over into others

// How the ocean is painted; most are the knobs of ocean.paint.
struct OceanPaint {
  float dither, lightDither, reflection;
  float phase;       // of the live texture, radians
  float liveSpread;  // radians
  float foam, foamStart;
  vec3 foamLit, foamShadowed;  // square roots
  float saturation, overlayAmount, skySaturation, skyOverlayAmount;
  vec3 overlay, skyOverlay;  // linear
  float next;                // how far the next maps count
  float fadeEnd;             // metres from its middle where waves end
  vec2 wind;                 // unit, x and z: where it blows to
};

SHARED_END
#endif
