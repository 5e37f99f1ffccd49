// Points on a surface to which something is tied that is drawn on the screen: as far apart from each other as
// may be, at every scale (paper 004, section 3.1, and beyond it).
#pragma once

#include "scene/scene_data.h"

namespace scumble::scene {

struct SurfaceAnchor {
  uint32_t a = 0, b = 0, c = 0;  // a triangle's vertices
  float toB = 0, toC = 0;        // where in it: a + toB (b - a) + toC (c - a)
  // No other anchor with as much or more lies nearer, on this side of the surface: metres in mesh space.
  // Those with at least some spacing are spread evenly by themselves, about 0.7 of them to its square, so
  // that a sparser set is a part of every denser one (FORMULAS 23).
  float spacing = 0;
  float area = 0;     // of the triangle in mesh space, square metres
  uint32_t seed = 0;  // a number of its own
  bool operator==(const SurfaceAnchor&) const = default;
};

// By spacing, the widest first; as many as so many candidates for their places allow, about a twentieth, and
// of fewer candidates the first ones of those. Follows from the primitive and `seed` alone. A surface without
// area has none.
std::vector<SurfaceAnchor> anchorsOf(const Primitive& primitive, uint32_t candidates, uint32_t seed);
// Of a primitive, in mesh space, square metres.
double areaOf(const Primitive& primitive);

}  // namespace scumble::scene
