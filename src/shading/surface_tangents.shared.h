#ifndef SCUMBLE_SURFACE_TANGENTS_SHARED_H
#define SCUMBLE_SURFACE_TANGENTS_SHARED_H
#include "shared_types.h"

#ifdef __cplusplus
namespace scumble::shared {
using glm::abs;
using glm::max;
using glm::smoothstep;
}  // namespace scumble::shared
#endif

SHARED_BEGIN
// How a use of MetaTexture counts, for a specialisation constant.
const int kFragmentGradients = 1;  // by differences between pixels
const int kCyclopean = 2;          // in stereo by the view between both eyes
const int kRadial = 4;             // evenly by the angle that a pixel subtends (eq. 11 to 13)
const int kByAngle = 8;            // by angles, not by how far those lie apart on the picture's plane
const int kRadialInPart = 16;      // kRadial, by radialPart()

// How much of that a view asks for that is neither narrow nor wide: by the tangent of the angle between its
// axis and the farther one of its sides. `toRay`: as ViewUniforms::ndcToEyeRay.
const float kNarrowView = 0.7f, kWideView = 1.0f;
SHARED_FUNCTION float radialPart(vec4 toRay) {
  float aside = abs(toRay.x) + abs(toRay.z), above = abs(toRay.y) + abs(toRay.w);
  return smoothstep(kNarrowView, kWideView, max(aside, above));
}
SHARED_END
#endif
