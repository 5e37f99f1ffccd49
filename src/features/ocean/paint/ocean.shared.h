#ifndef SCUMBLE_OCEAN_PAINT_SHARED_H
#define SCUMBLE_OCEAN_PAINT_SHARED_H
#include "../../../shading/shared_types.h"
#ifdef __cplusplus
#include "features/ocean/paint/ocean_knobs.h"
#endif

SHARED_BEGIN
#ifdef __cplusplus
using ocean::OceanPaintParams;
#else
struct OceanPaintParams {
#include "ocean_paint.params"
};
#endif

// Bindings of set 1 of the image step.
const int kOceanPatternBinding = 1, kOceanWavesBinding = 2, kOceanDepthBinding = 3, kOceanExampleBinding = 4,
          kOceanInverseBinding = 5, kOceanFoamBinding = 6, kOceanBathicBinding = 7, kOceanSkyBinding = 8,
          kOceanNextBathicBinding = 9, kOceanNextSkyBinding = 10;

// What the image step is specialised to.
const int kOceanNext = 1;     // colours go over into others
const int kOceanFollows = 2;  // strokes run across the view

// How the ocean is painted.
struct OceanPaint {
  OceanPaintParams knobs;
  float phase;                 // of the live texture, radians
  float liveSpread;            // radians
  vec3 foamLit, foamShadowed;  // square roots
  float fadeEnd;               // metres from its middle where waves end
  vec2 wind;                   // unit, x and z: where it blows to
};

SHARED_END
#endif
