#ifndef SCUMBLE_COLORIZE_SHARED_H
#define SCUMBLE_COLORIZE_SHARED_H
#include "../../shading/frame.shared.h"

SHARED_BEGIN

// Bindings of set 1.
const int kColorizeColor = 1, kColorizeDepth = 2, kColorizeBlended = 3, kColorizeBlendedDistance = 4;

// The air before overlays (background.air), and before blended surfaces by themselves: of the picture `color`
// has it.
struct ColorizeAir {
  vec3 horizon;
  float amount;      // 0 to 1
  float start, end;  // metres along the view axis
};

// As the shader tells volumes apart; a sphere is an ellipsoid whose space is the world's, but for the scale.
const int kShapeSphere = 0, kShapeEllipsoid = 1, kShapeBox = 2, kShapeCapsule = 3, kShapeHalfSpace = 4,
          kShapeScene = 5;

// What the colorizers of a look need, together: the bits 1 << Colorizer::type, and these.
const int kHasGamma = 1 << 12, kHasFalloff = 1 << 13, kHasSaturation = 1 << 14, kHasParallel = 1 << 15;

const int kMaxColorizers = 64;
// The picture is divided into at most so many columns, and rows.
const int kMaxStrips = 128;

// One colorizer, in rows, since the pixels of a quad read four of them together. Eyes are in the space of the
// unit shape, toUnit goes there from directions in the world, and graded is
// max(0, bias + color * C + gray * luminance(C)) ^ gamma.
const int kRowEyes = 0,    // of each view; w: of a sphere and of the scene, units of their space in a metre
    kRowBias = kMaxViews,  // w: density
    kRowColor = kRowBias + 1,    // w: (1 - b) / b of the knob b, the falloff
    kRowGray = kRowColor + 1,    // w: type: 2 * shape, and 1 more for fog
    kRowGamma = kRowGray + 1,    // w: half a capsule's axis in its space
    kRowToUnit = kRowGamma + 1,  // columns
    kColorizerRows = kRowToUnit + 3;
struct Colorizer {
  vec4 rows[kColorizerRows];
};

// Through a place of the picture, in normalised coordinates: middle + x * across + y * down.
struct SightLines {
  vec3 ray[3];     // to one metre before the eye's plane, world
  vec3 origin[3];  // where it starts, from the eye, world; 0 but for parallel projections
};

struct ColorizeUniforms {
  SightLines sights[kMaxViews];
  int stripBits;  // columns and rows have 1 << stripBits pixels
  // A bit for each colorizer that may be seen in a column, and in a row, of each view. A pixel sees what both
  // have.
  uvec2 columns[kMaxViews * kMaxStrips], rows[kMaxViews * kMaxStrips];
  Colorizer list[kMaxColorizers];
  ColorizeAir air;
};

SHARED_END
#endif
