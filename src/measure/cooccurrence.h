// Flatness: whether what stands on the screen has the look of the flat example.
#pragma once

#include <span>

#include "measure/field.h"

namespace scumble::measuring {

// How often two grey levels stand a given distance apart, in the example and in another field (Haralick's
// grey-level co-occurrence matrices): the difference of the two tables of shares, summed over its entries and
// halved, averaged over distances of 1, 2, 4 and 8 pixels and over the channels. 0: the same; 1: they have no
// pair of levels in common. Copeland, Ravichandran and Trivedi, "Texture synthesis using gray-level
// co-occurrence models" (Optical Engineering 40, 2001), whose average co-occurrence error Benard, Bousseau
// and Thollot, "Dynamic solid textures for real-time coherent stylization" (I3D 2009), use for flatness.
//
// Grey levels: 16 between 2.5 standard deviations below the example's mean and as much above it. The four
// directions of the pixel grid (0, 45, 90, 135 degrees) share one table, so that a texture that is turned is
// as flat as before. 1 where either has no pixels.
double cooccurrenceError(std::span<const Field> example, std::span<const Field> fields);

}  // namespace scumble::measuring
