// How far away what is drawn on a surface seems to be, for somebody with two eyes: as far as the surface, or
// elsewhere.
#pragma once

#include "measure/field.h"

namespace scumble::measuring {

struct Vergence {
  size_t windows = 0;    // that have something to see, of 13 x 13 pixels
  size_t conflicts = 0;  // of those, ones that fit a disparity better that is another one than the surface's
  double share() const { return windows ? double(conflicts) / double(windows) : 0; }
};

// `left`, `right`: the first number of what both eyes see; `places`: where the left one sees the points that
// the right one sees, which is the surface's own disparity. Eyes stand side by side, so others are sought
// along rows: as far as to where a thing on the screen would lie, and 8 pixels beyond, 64 at most.
Vergence vergenceOf(const Field& left, const Field& right, const Places& places);

}  // namespace scumble::measuring
