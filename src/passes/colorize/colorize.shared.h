#ifndef SCUMBLE_COLORIZE_SHARED_H
#define SCUMBLE_COLORIZE_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN

// As the shader tells them apart; a sphere is an ellipsoid whose space is the world's, but for the scale.
const int kShapeSphere = 0, kShapeEllipsoid = 1, kShapeBox = 2, kShapeCapsule = 3, kShapeHalfSpace = 4,
          kShapeScene = 5;

// What the colorizers of a job need, together: the bits 1 << shape, and these.
const int kHasFog = 64, kHasSurface = 128, kHasGamma = 256, kHasFalloff = 512, kHasParallel = 1024;

const int kMaxColorizers = 64;

struct Colorizer {
  vec3 eyes[2];    // of each view, in the space of the unit shape
  mat3 toUnit;     // from directions in the world
  float perMetre;  // of a sphere and of the scene: units of that space in a metre
  float axis;      // half a capsule's axis there
  int shape;
  int atmospheric;
  float density;
  float falloff;  // (1 - b) / b of the knob b: amount = x / (x + falloff (1 - x))
  // Graded: max(0, bias + color * C + gray * luminance(C)) ^ gamma.
  vec3 bias, color, gray, gamma;
};

struct ColorizeUniforms {
  int once;  // 1: how often each chunk of the list is run; compilers must not know
  Colorizer list[kMaxColorizers];
};

SHARED_END
#endif
