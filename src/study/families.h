// The two families of a picture: what is light and what is dark.
#pragma once

#include "scumble/study.h"
#include "study/plane.h"

namespace scumble::study {

// The lightness that parts the picture's with the greatest variance between the two sides (Otsu, "A threshold
// selection method from gray-level histograms", 1979). Of a picture of one value, that value.
double divisionOf(const Plane& lightness);

// Of the pixels that are lighter than `division`, or of the others.
ColorFamily familyOf(const LabPicture& picture, double division, bool isLight);

}  // namespace scumble::study
