// Where splats may lie along strokes (Schmid et al. 2011; paper 003, section 3).
#pragma once

#include "scene/painting.h"

namespace scumble::scene {

struct SplatPlace {
  uint32_t point;  // of the painting: the one before it
  float toNext;    // its part of the next one
  float spacing;   // radii to the next splat that counts at least as much; a stroke's ends count most
};

// Between two splats, radii.
constexpr float kSplatSpacing = 0.25f;

// Of a scene, but for the ends of strokes; more than that, and they lie farther apart.
constexpr double kMostSplats = 4 << 20;

// What a stroke has by chance, 16 bits of it: the same wherever it is drawn.
uint32_t strokeChance(size_t stroke);

// Of all strokes, in painting order, so many radii apart: every second one counts more than those between,
// every fourth more than those, and so on, so that a sparser set is a part of every denser one. `along`: gets
// by point how far it is from its stroke's beginning, radii.
std::vector<SplatPlace> splatPlaces(const Painting& painting, std::vector<float>& along,
                                    float least = kSplatSpacing);

// How many there are between the ends of strokes, without finding them.
double splatCount(const Painting& painting, float least);

}  // namespace scumble::scene
