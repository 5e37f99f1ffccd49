// Lines: what is dark, thin, and between areas.
#pragma once

#include <vector>

#include "scumble/study.h"
#include "study/plane.h"

namespace scumble::study {

constexpr double kBorderSlope = 0.02;  // OKLab lightness a pixel from which on a place is a border

// A picture without its thin dark lines, and what was taken away.
struct Unlined {
  Plane areas;               // lightness
  Plane drawn;               // how much darker the picture is
  Plane steep;               // of the areas
  double depth = 0;          // OKLab lightness by which lines are darker than what is beside them
  std::vector<bool> isEven;  // where there is neither a line nor a border between areas
};

// `marks`: the contrast of what brushes leave on areas. Lines are several times deeper.
Unlined withoutLines(const LabPicture& picture, double marks);

StudiedLines linesOf(const LabPicture& picture, const Unlined& unlined);

}  // namespace scumble::study
