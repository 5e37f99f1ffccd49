// The colours that a picture is painted with.
#pragma once

#include <vector>

#include "study/plane.h"

namespace scumble::study {

struct LabColor {
  glm::dvec3 lab{0};
  double share = 0;
};

struct Palette {
  std::vector<LabColor> colors;  // the largest share first
  double fewness = 0;            // share of what is even within kNearColors of one of them
};

// Groups of the picture's colours where `isEven`: k-means in OKLab from the most frequent colour on, each
// further one where most of the picture is farthest from those that are there; what is nearer than
// kNearColors becomes one, and what is less than a 500th of what is even is left out.
Palette paletteOf(const LabPicture& picture, const std::vector<bool>& isEven);

}  // namespace scumble::study
