#ifndef SCUMBLE_SURFACE_TANGENTS_SHARED_H
#define SCUMBLE_SURFACE_TANGENTS_SHARED_H
#include "shared_types.h"

SHARED_BEGIN
// How a use of MetaTexture counts, for a specialisation constant.
const int kFragmentGradients = 1;  // by differences between pixels
const int kCyclopean = 2;          // in stereo by the view between both eyes
const int kRadial = 4;             // evenly by the angle that a pixel subtends (eq. 11 to 13)
const int kByAngle = 8;            // by angles, not by how far those lie apart on the picture's plane
SHARED_END
#endif
