// Example textures of brush strokes, painted by code. Integers only: the bytes are the same on every machine.
#pragma once

#include "base/pixels.h"

namespace scumble {

// Strokes as of a sea. R, G and B are three patterns that know nothing of each other, so that every mix of
// them is a pattern of strokes, too. Each has five values in equal parts, and mean 0.5. Strokes lie along u.
// Repeats along u and v; 256 x 256 values (not sRGB).
Pixels seaStrokes();

// Where foam is: a texel has foam where value / 255 < cover. Cover 0.2 leaves sparse flecks, 0.5 broken
// patches, 0.8 foam with holes; the foam's part of the map is the cover itself. Nothing, foam or hole, is
// smaller than the brush, a lens of 8 x 3 texels. Streaks lie along u. Repeats along u and v; 256 x 256
// values (not sRGB), the same in R, G and B.
Pixels foamStrokes();

}  // namespace scumble
