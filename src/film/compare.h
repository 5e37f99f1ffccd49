// How different two pictures look to a person: for golden tests, where drivers round differently but a moved
// line or a changed colour must not pass.
#pragma once

#include "scumble/image.h"

namespace scumble::film {

// 0: looks the same; 1: as different as green and blue (black against white: 0.96). For golden tests: `mean`
// catches what is everywhere a little, `tile` what is wrong in one place, `max` tells how wrong.
struct Difference {
  double mean = 0;
  double tile = 0;  // the largest mean of a tile of kDifferenceTile pixels a side
  double max = 0;
};
constexpr uint32_t kDifferenceTile = 16;

// FLIP (Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", HPG 2020) for pictures seen
// at 67 pixels per degree. In every pixel
//     FLIP = dE_c ^ (1 - dE_f)
// where dE_c is the colour difference after both pictures were blurred as the eye blurs (contrast sensitivity
// functions in YCxCz), by HyAB in Hunt-adjusted L*a*b*, scaled to 0 ... 1; and dE_f the difference of edges
// and points in luminance. Symmetric. Colours are linear and clamped to 0 ... 1. A picture with alpha is seen
// over black and over white, and the larger difference counts. One channel is grey. Pictures of different
// sizes differ by 1.
Difference comparePictures(const Image& a, const Image& b);

}  // namespace scumble::film
