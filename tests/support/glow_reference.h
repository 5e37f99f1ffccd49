// The glow around what acts on the lens, in double precision.
#pragma once

#include "tests/support/aov.h"

namespace scumble::test {

// At a quarter of the size, in X: the mean of what acts on the lens in the AOV `shadow`, spread by (1 -
// r^2)^4 along x and along y, which ends at `reach` percent of the picture's height. Nothing comes from
// outside. Sizes are multiples of four.
Texels glowReference(const Image& shadow, double reach);

}  // namespace scumble::test
