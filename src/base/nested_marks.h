// An example texture whose marks lie on those of its own copies at half the size, so that a zoom adds marks
// and removes none.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "base/pixels.h"

namespace scumble {

// Places in [0, 1)^2, in copies of the texture. With (x, y) among them are (2x mod 1, y) and (x, 2y mod 1): a
// copy that is half as large along u, along v or along both has a mark wherever the larger one has one (after
// the idea of Dither3D by R. S. Johansen, whose dots keep their places; there the scale is one for both
// axes).
std::vector<glm::dvec2> nestedPlaces();

// A mark at each of these places, all over it, of its own form, about twice as long along v as along u; 0.42
// of the texture's area. Repeats along u and v; 256 x 256 values (not sRGB), the same in R, G and B.
Pixels nestedMarks();

}  // namespace scumble
