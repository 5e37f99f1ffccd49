#ifndef SCUMBLE_SURFACE_OCEAN_SHARED_H
#define SCUMBLE_SURFACE_OCEAN_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN

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
};

SHARED_END
#endif
