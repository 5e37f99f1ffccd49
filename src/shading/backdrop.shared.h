// How a picture lies behind everything, and how far it takes part in the style (docs/backdrop.md).
#ifndef SCUMBLE_BACKDROP_SHARED_H
#define SCUMBLE_BACKDROP_SHARED_H
#include "frame.shared.h"
#include "palette.shared.h"
#include "shared_types.h"

SHARED_BEGIN
// What of it is used, for a specialisation constant.
const int kBackdropIsThere = 1;
const int kBackdropMinified = 2;
const int kBackdropSimplified = 4;
const int kBackdropMixed = 8;  // simplified by less than a pixel: as it is, in part
const int kBackdropStyled = 16;
const int kBackdropStepped = 128;  // in flat shapes
const int kBackdropLimited = 256;  // in the colours of a palette
const int kBackdropTornNear = 32;  // where something is near
const int kBackdropTorn = 64;      // everywhere

struct Backdrop {
  vec2 scale;                      // texture coordinates per part of the frame, from the middle of both
  float minified;                  // 0 to 1: how much finer than a pixel its texels are, up to half a pixel
  float radius;                    // pixels that are simplified into one area; 0: none
  float sectorLevel;               // the mip level that is read for a part of such an area
  float steps;                     // of lightness, in which it is painted flat; 0: none
  float limited;                   // how far its colours go to a palette's
  float style;                     // how far its colours go through the palette rule
  int warp;                        // 0 none, 1 near, 2 everywhere
  float tear;                      // pixels: how far it is torn where it is torn everywhere
  vec2 tearSize;                   // pixels: a copy of the pattern for that
  vec2 tearShift;                  // copies
  float groundHeight;              // world
  float matteNear, matteFar;       // metres along the view axis: between them the ground's shadow fades
  vec3 shadowTint;                 // factors on its colours in shadow, as for every face that looks up
  ColorMap lit;                    // the palette rule in light
  ColorMap shadowed, litShadowed;  // in shadow, for its own colours, and for those that went through the rule
  float lightness;                 // that palette: OKLab with L multiplied by this; the last one repeated
  vec3 palette[kMaxPaletteColors];
};
SHARED_END
#endif
